// Rows of the ledger.
#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/revision/revision.hpp"

namespace ballbar {
namespace {

// A constant on 0, 1, 2, 3, 4 um, one a minute. RMSE: sqrt((4 + 1 + 0 + 1 + 4) / 5) = sqrt(2). Each of the five parts
// of the time is one row, predicted by the mean of the others: v - (10 - v) / 4 = 5 (v - 2) / 4, so that the RMSE of
// what was left out is 5/4 sqrt(2), to the 1e-4 by which parameters are held near 0 where cycles are left out. Fewer
// than 30 values: the noise is white.
TEST(Ledger, row_of_a_constant_by_hand) {
  Series data;
  data.time_s = {0.0, 60.0, 120.0, 180.0, 240.0};
  data.columns = {{"z_um", Role::measured, {0.0, 1.0, 2.0, 3.0, 4.0}}};
  Model model;
  model.targets = {"z_um"};
  const LedgerRow found = row_of(model, data);
  EXPECT_EQ(found.revision, 0u);
  EXPECT_EQ(found.change, "start");
  EXPECT_EQ(found.verdict, "start");
  EXPECT_EQ(found.target, "z_um");
  EXPECT_EQ(found.parameters, 1u);
  EXPECT_NEAR(found.rmse_um, std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(found.held_out_um, 1.25 * std::sqrt(2.0), 1e-4);
  EXPECT_TRUE(std::isnan(found.likelihood_ratio));
}

}  // namespace
}  // namespace ballbar

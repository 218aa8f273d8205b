// Rows and sentences of the ledger.
#include "ballbar/revision/ledger.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ballbar {
namespace {

LedgerRow row(std::size_t revision, std::string change, double rmse_um, double times_floor, double held_out_um) {
  LedgerRow result;
  result.revision = revision;
  result.change = std::move(change);
  result.target = "z_um";
  result.data = {"run.csv"};
  result.rmse_um = rmse_um;
  result.times_floor = times_floor;
  result.held_out_um = held_out_um;
  return result;
}

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

TEST(Ledger, sentence_of_the_start) {
  EXPECT_EQ(sentence(row(0, "start", 12.34, 4.0, 140.4), nullptr),
            "The model started with RMSE 12.3 um (4.00 times the noise), left-out cycles 140 um.");
}

TEST(Ledger, sentence_of_recordings) {
  LedgerRow of_recordings = row(0, "start", 12.34, 4.0, 140.4);
  of_recordings.level = Level::recording;
  EXPECT_EQ(sentence(of_recordings, nullptr),
            "The model started with RMSE 12.3 um (4.00 times the noise), left-out recordings 140 um.");
}

TEST(Ledger, sentence_of_an_addition) {
  const LedgerRow before = row(1, "+ expansion(T2_degC)", 12.34, 14.0, 14.04);
  LedgerRow after = row(2, "+ lagged_expansion(T16_degC)", 3.1, 1.0, 3.9);
  after.likelihood_ratio = 431.23;
  after.threshold = 25.0;
  after.still_needed = {"speed_heating(speed_rpm)"};
  EXPECT_EQ(
      sentence(after, &before),
      "Revision 2 added lagged_expansion(T16_degC). RMSE 12.3 -> 3.10 um (14.0 -> 1.00 times the noise), left-out "
      "cycles 14.0 -> 3.90 um. 2 ln B is 431.2 (threshold 25.0). "
      "speed_heating(speed_rpm) is still needed.");
}

// Of errors of the axes the threshold is a quantile of chi^2, of other effects 10 each.
TEST(Ledger, sentence_of_an_addition_on_recordings) {
  LedgerRow after = row(1, "+ backlash_a", 0.2, 1.0, 0.3);
  after.level = Level::recording;
  after.likelihood_ratio = 927.2;
  const std::string begin =
      "Revision 1 added backlash_a. RMSE 0.200 um (1.00 times the noise), left-out recordings 0.300 um.";
  EXPECT_EQ(sentence(after, nullptr), begin + " chi^2 is 927.2.");
  after.threshold = 14.3;
  EXPECT_EQ(sentence(after, nullptr), begin + " chi^2 is 927.2 (threshold 14.3).");
  after.threshold = 20.0;
  EXPECT_EQ(sentence(after, nullptr), begin + " 2 ln B is 927.2 (threshold 20.0).");
}

TEST(Ledger, sentence_of_effects_taken_out) {
  const LedgerRow before = row(1, "+ step", 0.5, LedgerRow::kUnknown, 0.6);
  LedgerRow after = row(2, "+ gradient_bending(T3_degC, T16_degC), - step, - settling", 0.25, LedgerRow::kUnknown,
                        LedgerRow::kUnknown);
  after.no_longer_needed = {"linear_drift", "day_cycle"};
  EXPECT_EQ(sentence(after, &before),
            "Revision 2 added gradient_bending(T3_degC, T16_degC) and took out step, settling. RMSE 0.500 -> 0.250 um. "
            "linear_drift, day_cycle are no longer needed.");
}

// What was before is told only where it is of the same target and data.
TEST(Ledger, sentence_after_a_row_of_other_data) {
  LedgerRow before = row(0, "start", 12.3, 4.0, 14.0);
  const LedgerRow after = row(1, "+ step", 3.1, 1.0, 3.9);
  before.data = {"other.csv"};
  const std::string alone = "Revision 1 added step. RMSE 3.10 um (1.00 times the noise), left-out cycles 3.90 um.";
  EXPECT_EQ(sentence(after, &before), alone);
  EXPECT_EQ(sentence(after, nullptr), alone);
  before.data = after.data;
  before.target = "x_um";
  EXPECT_EQ(sentence(after, &before), alone);
}

}  // namespace
}  // namespace ballbar

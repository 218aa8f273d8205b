// Folds of recordings.
#include <gtest/gtest.h>

#include "../diagnosis/made_recordings.hpp"
#include "diagnosis/by_hand.hpp"
#include "series/folds.hpp"

namespace ballbar {
namespace {

TEST(FoldsOfRecordings, are_the_recordings) {
  const Series trace = made::circles(made::both_ways(), 8);
  const std::vector<std::size_t> expected{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(folds_of(trace, made::all_rows(trace)), expected);
}

TEST(FoldsOfRecordings, are_quarters_of_a_sweep_that_is_alone) {
  const Series trace = made::circles(made::one_way(), 8);
  const std::vector<std::size_t> expected{0, 0, 1, 1, 2, 2, 3, 3};
  EXPECT_EQ(folds_of(trace, made::all_rows(trace)), expected);
}

// A gain that one recording alone knows cannot be predicted from the other.
TEST(FoldsOfRecordings, are_quarters_of_all_sweeps_for_a_gain_of_one_recording) {
  const Series trace = made::circles(made::both_ways(), 8);
  const std::vector<std::size_t> fold = folds_of(trace, made::all_rows(trace));
  const std::vector<std::size_t> quarters{0, 0, 1, 1, 2, 2, 3, 3, 0, 0, 1, 1, 2, 2, 3, 3};
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(16, 1);
  EXPECT_EQ(folds_that_tell(trace, made::all_rows(trace), fold, columns), fold);
  columns.bottomRows(8).setZero();
  EXPECT_EQ(folds_that_tell(trace, made::all_rows(trace), fold, columns), quarters);
}

TEST(Folds, cycles_end_with_changes_of_speed) {
  Series data = by_hand::rows_of(40, 60.0);
  std::vector<double> speed(40, 0.0);
  for (std::size_t i = 10; i < 30; ++i) speed[i] = i < 20 ? 3000.0 : 6000.0;
  data.columns = {{"speed_rpm", Role::speed, speed}};
  std::vector<std::size_t> rows(40);
  for (std::size_t i = 0; i < 40; ++i) rows[i] = i;
  const std::vector<std::size_t> fold = folds_of(data, rows);
  for (const std::size_t change : {10U, 20U, 30U}) {
    EXPECT_NE(fold[change], fold[change - 1]) << change;
    EXPECT_EQ(fold[change], fold[change + 1]) << change;
  }
}

}  // namespace
}  // namespace ballbar

// Sentences on rows of the ledger.
#include "diagnose/ledger_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

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

TEST(LedgerText, of_the_start) {
  EXPECT_EQ(text_of(sentence_of(row(0, "start", 12.34, 4.0, 140.4), nullptr)),
            "The model started with RMSE 12.3 um (4.00 times the noise), left-out cycles 140 um.");
}

TEST(LedgerText, of_recordings) {
  LedgerRow of_recordings = row(0, "start", 12.34, 4.0, 140.4);
  of_recordings.level = Level::recording;
  EXPECT_EQ(text_of(sentence_of(of_recordings, nullptr)),
            "The model started with RMSE 12.3 um (4.00 times the noise), left-out recordings 140 um.");
}

TEST(LedgerText, of_an_addition) {
  const LedgerRow before = row(1, "+ expansion(T2_degC)", 12.34, 14.0, 14.04);
  LedgerRow after = row(2, "+ lagged_expansion(T16_degC)", 3.1, 1.0, 3.9);
  after.likelihood_ratio = 431.23;
  after.threshold = 25.0;
  after.still_needed = {"speed_heating(speed_rpm)"};
  EXPECT_EQ(
      text_of(sentence_of(after, &before)),
      "Revision 2 added lagged_expansion(T16_degC). RMSE 12.3 -> 3.10 um (14.0 -> 1.00 times the noise), left-out "
      "cycles 14.0 -> 3.90 um. 2 ln B is 431.2 (threshold 25.0). "
      "speed_heating(speed_rpm) is still needed.");
}

// Of errors of the axes the threshold is a quantile of chi^2, of other effects 10 each.
TEST(LedgerText, of_an_addition_on_recordings) {
  LedgerRow after = row(1, "+ backlash_a", 0.2, 1.0, 0.3);
  after.level = Level::recording;
  after.likelihood_ratio = 927.2;
  const std::string begin =
      "Revision 1 added backlash_a. RMSE 0.200 um (1.00 times the noise), left-out recordings 0.300 um.";
  EXPECT_EQ(text_of(sentence_of(after, nullptr)), begin + " chi^2 is 927.2.");
  after.threshold = 14.3;
  EXPECT_EQ(text_of(sentence_of(after, nullptr)), begin + " chi^2 is 927.2 (threshold 14.3).");
  after.threshold = 20.0;
  EXPECT_EQ(text_of(sentence_of(after, nullptr)), begin + " 2 ln B is 927.2 (threshold 20.0).");
}

TEST(LedgerText, of_effects_taken_out) {
  const LedgerRow before = row(1, "+ step", 0.5, LedgerRow::kUnknown, 0.6);
  LedgerRow after = row(2, "+ gradient_bending(T3_degC, T16_degC), - step, - settling", 0.25, LedgerRow::kUnknown,
                        LedgerRow::kUnknown);
  after.no_longer_needed = {"linear_drift", "day_cycle"};
  EXPECT_EQ(text_of(sentence_of(after, &before)),
            "Revision 2 added gradient_bending(T3_degC, T16_degC) and took out step, settling. RMSE 0.500 -> 0.250 um. "
            "linear_drift, day_cycle are no longer needed.");
}

// What was before is told only where it is of the same target and data.
TEST(LedgerText, after_a_row_of_other_data) {
  LedgerRow before = row(0, "start", 12.3, 4.0, 14.0);
  const LedgerRow after = row(1, "+ step", 3.1, 1.0, 3.9);
  before.data = {"other.csv"};
  const std::string alone = "Revision 1 added step. RMSE 3.10 um (1.00 times the noise), left-out cycles 3.90 um.";
  EXPECT_EQ(text_of(sentence_of(after, &before)), alone);
  EXPECT_EQ(text_of(sentence_of(after, nullptr)), alone);
  before.data = after.data;
  before.target = "x_um";
  EXPECT_EQ(text_of(sentence_of(after, &before)), alone);
}

}  // namespace
}  // namespace ballbar

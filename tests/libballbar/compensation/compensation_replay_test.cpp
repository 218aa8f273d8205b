#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

// z = 2 um/K (T_a - T_a0)
CompensatedAxis z_axis() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_a_degC"})};
  model.terms[0].settings[0].start = 2.0;
  return {"z", model};
}

CompensationLimits quick() {
  CompensationLimits limits;
  limits.rate_um_per_s = 100.0;
  limits.step_um = 100.0;
  limits.spike_K = 100.0;
  return limits;
}

// Rows at 0, 10, 20 s with 20, 21, 23 degC give offsets 0, -2, -6 um. The error is measured at 10 s, which the offset
// of the row at 0 s meets; at 15 s, met by that of 10 s; at 20 s, also met by that of 10 s.
TEST(Replay, MeetsAnErrorWithTheOffsetOfTheLastRowBeforeIt) {
  const Series signals{{0.0, 10.0, 20.0}, {{"T_a_degC", Role::bearing, {20.0, 21.0, 23.0}}}};
  const Series measured{{0.0, 10.0, 15.0, 20.0}, {{"z_um", Role::measured, {5.0, 7.5, 8.0, 11.0}}}};
  const Replay replay = replay_of({z_axis()}, quick(), {signals}, measured);
  const ReplayedAxis& z = replay.axes[0];
  EXPECT_EQ(z.before_um, (std::vector<double>{0.0, 2.5, 3.0, 6.0}));
  EXPECT_EQ(z.offset_um, (std::vector<double>{0.0, 0.0, -2.0, -2.0}));
  EXPECT_EQ(z.after_um, (std::vector<double>{0.0, 2.5, 1.0, 4.0}));
  EXPECT_NEAR(z.reduction.before_um, std::sqrt((2.5 * 2.5 + 9.0 + 36.0) / 3.0), 1e-12);
  EXPECT_NEAR(z.reduction.after_um, std::sqrt((2.5 * 2.5 + 1.0 + 16.0) / 3.0), 1e-12);
  EXPECT_EQ(replay.rows, 3U);
  EXPECT_EQ(z.rows_held[0], 3U);
}

// The future cannot be seen: whatever comes after 20 s, all before it is as it was.
TEST(Replay, LooksAtNothingAhead) {
  Series signals{{0.0, 10.0, 20.0, 30.0}, {{"T_a_degC", Role::bearing, {20.0, 21.0, 23.0, 24.0}}}};
  Series measured{{0.0, 10.0, 20.0, 30.0}, {{"z_um", Role::measured, {0.0, 2.0, 6.0, 8.0}}}};
  const Replay one = replay_of({z_axis()}, quick(), {signals}, measured);
  signals.columns[0].values[3] = 90.0;
  signals.columns[0].values[2] = 80.0;
  measured.columns[0].values[3] = 500.0;
  const Replay other = replay_of({z_axis()}, quick(), {signals}, measured);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(one.axes[0].after_um[i], other.axes[0].after_um[i]) << i;
  EXPECT_NE(one.axes[0].after_um[3], other.axes[0].after_um[3]);
}

// Two loggers on clocks of their own: a column keeps its latest value, for at most gap_s.
TEST(Replay, KeepsTheLatestValueOfEachSignalForAWhile) {
  CompensationLimits limits = quick();
  limits.gap_s = 25.0;
  CompensatedAxis z = z_axis();
  z.model.terms.push_back(term_of("expansion", {"T_b_degC"}));
  z.model.terms[1].settings[0].start = 1.0;
  const Series a{{0.0, 10.0, 20.0, 30.0, 40.0}, {{"T_a_degC", Role::bearing, {20.0, 20.0, kGap, 20.0, 20.0}}}};
  const Series b{{5.0, 12.0}, {{"T_b_degC", Role::bearing, {20.0, 24.0}}}};
  const Series measured{{6.0, 15.0, 45.0}, {{"z_um", Role::measured, {0.0, 4.0, 4.0}}}};
  const ReplayedAxis replayed = replay_of({z}, limits, {a, b}, measured).axes[0];
  EXPECT_EQ(replayed.after_um, (std::vector<double>{0.0, 0.0, 0.0}));
  // 0 s: no T_b yet; 20 s: T_a gives none; 40 s: T_b is 28 s old.
  EXPECT_EQ(replayed.rows_held[static_cast<std::size_t>(Hold::no_value)], 3U);
  EXPECT_EQ(replayed.rows_held[static_cast<std::size_t>(Hold::none)], 4U);
  EXPECT_EQ(replayed.most_held_by, "T_b_degC");
}

TEST(Replay, SaysWhatIsMissing) {
  const auto expect_error = [](const std::vector<Series>& signals, const Series& measured, const std::string& message) {
    try {
      replay_of({z_axis()}, quick(), signals, measured);
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), message);
    }
  };
  const Series signals{{0.0, 10.0}, {{"T_a_degC", Role::bearing, {20.0, 21.0}}}};
  const Series other{{0.0, 10.0}, {{"T_b_degC", Role::bearing, {20.0, 21.0}}}};
  const Series measured{{0.0, 10.0}, {{"z_um", Role::measured, {0.0, 2.0}}}};
  expect_error({other}, measured,
               "expected the column T_a_degC among the signals, which the model reads, found none; the nearest is "
               "T_b_degC.");
  expect_error({}, measured, "expected the column T_a_degC among the signals, which the model reads, found none.");
  expect_error({signals}, other, "z: expected the measured column z_um, found none.");
  expect_error({signals}, {{10.0, 20.0}, {{"z_um", Role::measured, {0.0, kGap}}}},
               "z: expected at least two values of z_um after the first row of the signals, found 1.");
}

}  // namespace
}  // namespace ballbar

// Every error recovered from a test that is made of it alone, by plain formulas, and from one that has all of them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "made_errors.hpp"

namespace ballbar {
namespace {

MachineErrors without_prior(const made::ErrorTest& test) {
  return machine_errors(made::both_runs(test), {.prior = false});
}

struct Alone {
  const char* name;
  double value;
  const char* unit;
};

void PrintTo(const Alone& alone, std::ostream* out) { *out << alone.name; }

constexpr Alone kErrors[] = {
    {"global_scale", 12.0, "um"},
    {"centre_a", 9.0, "um"},
    {"centre_b", -7.0, "um"},
    {"radius_change", -3.0, "um"},
    {"offset_a_shift", 2.0, "um"},
    {"offset_b_shift", 1.5, "um"},
    {"scale_mismatch", 8.0, "um"},
    {"squareness", -31.0, "um/m"},
    {"straightness_a", 6.0, "um"},
    {"straightness_b", -5.0, "um"},
    {"servo_mismatch", 0.25, "ms"},
    {"sin_4_theta", 1.5, "um"},
    {"backlash_a_pos", 3.0, "um"},
    {"backlash_a_neg", -2.0, "um"},
    {"backlash_b_pos", 4.0, "um"},
    {"backlash_b_neg", 1.0, "um"},
    {"lateral_play_a_pos", 3.0, "um"},
    {"lateral_play_a_neg", -2.0, "um"},
    {"lateral_play_b_pos", -1.0, "um"},
    {"lateral_play_b_neg", 2.5, "um"},
    {"cyclic_error_a_fwd", 2.0, "um"},
    {"cyclic_error_a_rev", 3.0, "um"},
    {"cyclic_error_b_fwd", 1.0, "um"},
    {"cyclic_error_b_rev", 2.5, "um"},
    {"reversal_spike_a_pos", 5.0, "um"},
    {"reversal_spike_a_neg", 3.0, "um"},
    {"reversal_spike_b_pos", -2.0, "um"},
    {"reversal_spike_b_neg", 4.0, "um"},
    {"cubic_error_along", 3.0, "um"},
    {"cubic_error_across", -2.0, "um"},
};

// Without noise a least squares gives back what went in. Not so beside waves: cyclic errors are read on what a fit
// without any leaves, so that they take a share of a cubic error. Nor beside spikes, whose ends of 0.3 % they take.
constexpr double kExact_um = 0.01;
constexpr double kSpikes_um = 0.05;
constexpr double kShareOfCyclic = 0.05;
constexpr double kShareOfCubic = 0.2;

bool is_wave(const std::string& name) { return name.starts_with("cyclic") || name.starts_with("cubic"); }

double limit_um(const Alone& alone) {
  const bool cubic = std::string(alone.name).starts_with("cubic");
  if (is_wave(alone.name)) return (cubic ? kShareOfCubic : kShareOfCyclic) * std::abs(alone.value);
  return std::string(alone.name).starts_with("reversal") ? kSpikes_um : kExact_um;
}

class ErrorAlone : public testing::TestWithParam<Alone> {};

TEST_P(ErrorAlone, IsFoundAndNothingElse) {
  made::ErrorTest test = made::full_turn();
  test.errors[GetParam().name] = GetParam().value;
  const MachineErrors found = without_prior(test);
  EXPECT_EQ(found.errors.size(), std::size(kErrors));
  for (const MachineError& row : found.errors) {
    EXPECT_NEAR(row.value, test.of(row.name), limit_um(GetParam())) << row.name;
    if (row.name == GetParam().name) {
      EXPECT_EQ(row.unit, GetParam().unit);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(machine_errors, ErrorAlone, testing::ValuesIn(kErrors),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(MachineErrors, AllTogetherAreFound) {
  made::ErrorTest test = made::full_turn();
  for (const Alone& one : kErrors) test.errors[one.name] = is_wave(one.name) ? 0.0 : one.value;
  const MachineErrors found = without_prior(test);
  for (const MachineError& row : found.errors) EXPECT_NEAR(row.value, test.of(row.name), 0.05) << row.name;
  EXPECT_LT(found.residual_rms_um, 0.04);  // the curves at means of half a degree
}

TEST(MachineErrors, WavesBesideAllOthersAreFound) {
  made::ErrorTest test = made::full_turn();
  for (const Alone& one : kErrors) {
    if (!std::string(one.name).starts_with("reversal")) test.errors[one.name] = one.value;
  }
  const MachineErrors found = without_prior(test);
  for (const MachineError& row : found.errors) EXPECT_NEAR(row.value, test.of(row.name), 0.05) << row.name;
}

// 0.5 mm off centre: a^2 / 2 R = 0.8 um of second order, which is no oval of the axes.
TEST(MachineErrors, AFarCentreIsNoOval) {
  made::ErrorTest test = made::full_turn();
  test.errors = {{"centre_a", 500.0}, {"centre_b", -300.0}, {"global_scale", 20.0}, {"squareness", 20.0}};
  const MachineErrors found = without_prior(test);
  for (const MachineError& row : found.errors) EXPECT_NEAR(row.value, test.of(row.name), 0.02) << row.name;
}

// Pitches that are not told are looked for.
TEST(MachineErrors, PitchIsSearched) {
  made::ErrorTest test = made::full_turn();
  test.errors = {{"cyclic_error_a_fwd", 2.0},
                 {"cyclic_error_a_rev", 2.0},
                 {"cyclic_error_b_fwd", 2.0},
                 {"cyclic_error_b_rev", 2.0}};
  test.pitch_stated = false;
  test.pitch_a_mm = 12.0;
  test.pitch_b_mm = 16.0;
  const MachineErrors found = machine_errors(made::both_runs(test));
  int pitches = 0;
  for (const RankedError& one : found.ranked) {
    if (one.effect->name == "cyclic_error_a") pitches += one.shape == 12.0 ? 1 : 0;
    if (one.effect->name == "cyclic_error_b") pitches += one.shape == 16.0 ? 1 : 0;
  }
  EXPECT_EQ(pitches, 2);
}

// Of two runs with amplitudes of their own: the larger, or the mean.
TEST(MachineErrors, CyclicAmplitudeIsTheLargerOrTheMeanOfBothRuns) {
  made::ErrorTest ccw = made::full_turn(), cw = made::full_turn();
  ccw.errors = {{"cyclic_error_a_fwd", 2.0}, {"cyclic_error_a_rev", 2.0}};
  cw.errors = {{"cyclic_error_a_fwd", 4.0}, {"cyclic_error_a_rev", 4.0}};
  std::mt19937_64 random(1);
  const std::vector<Recording> recordings{made::run_of(ccw, Direction::CCW, random),
                                          made::run_of(cw, Direction::CW, random)};
  const auto forwards_um = [&](CyclicOfRuns of_runs) {
    const MachineErrors found = machine_errors(recordings, {.cyclic_of_runs = of_runs});
    for (const MachineError& row : found.errors) {
      if (row.name == "cyclic_error_a_fwd") return row.value;
    }
    return 0.0;
  };
  EXPECT_NEAR(forwards_um(CyclicOfRuns::larger), 4.0, 0.3);
  EXPECT_NEAR(forwards_um(CyclicOfRuns::mean), 3.0, 0.3);
}

// IC by hand: |SQ| R, |MM| / 2, bow / 2, |SM| v, max of |backlash|, max over the turn of |sin (G + M cos)|.
TEST(MachineErrors, IndividualCircularityIsPeakToPeakOfItsOwnCurve) {
  made::ErrorTest test = made::full_turn();
  test.errors = {{"squareness", 20.0},        {"scale_mismatch", 8.0},    {"straightness_a", -5.0},
                 {"servo_mismatch", 0.09},    {"backlash_a_pos", 2.0},    {"backlash_a_neg", 1.0},
                 {"lateral_play_b_pos", 1.7}, {"lateral_play_b_neg", 1.7}};
  const MachineErrors found = without_prior(test);
  const std::map<std::string, double> by_hand{{"squareness", 3.0},     {"scale_mismatch", 4.0},
                                              {"straightness_a", 2.5}, {"servo_mismatch", 1.5},
                                              {"backlash_a", 2.0},     {"lateral_play_b", 1.7}};
  double sum_um = 0.0;
  for (const RankedError& one : found.ranked) {
    const auto expected = by_hand.find(one.effect->name);
    EXPECT_NEAR(one.individual_circularity_um, expected == by_hand.end() ? 0.0 : expected->second, 0.02)
        << one.effect->name;
    sum_um += one.individual_circularity_um;
  }
  int significant = 0;
  for (const RankedError& one : found.ranked) {
    if (!by_hand.contains(one.effect->name)) continue;
    significant += one.significant ? 1 : 0;
    EXPECT_EQ(one.predicts_other_run, true);
    EXPECT_NEAR(one.share_percent, 100.0 * one.individual_circularity_um / sum_um, 1e-9);
  }
  EXPECT_EQ(significant, 6);
}

// Ovals of 4 um along the axes and of 3 um along the diagonals: together sqrt(4^2 + 3^2) = 5 um. Without one of them
// the other is left, so that the first gains 2 and the second 1; without both nothing is left.
TEST(MachineErrors, RankIsByWhatMendingGains) {
  made::ErrorTest test = made::full_turn();
  test.errors = {{"scale_mismatch", 8.0}, {"squareness", 20.0}};
  const MachineErrors found = without_prior(test);
  EXPECT_NEAR(found.circularity_um, 5.0, 0.02);
  EXPECT_NEAR(found.circularity_without_all_um, 0.0, 0.1);
  ASSERT_GE(found.ranked.size(), 3U);
  EXPECT_EQ(found.ranked[0].effect->name, "scale_mismatch");
  EXPECT_EQ(found.ranked[0].rank, 1U);
  EXPECT_NEAR(found.ranked[0].gain_um, 2.0, 0.05);
  EXPECT_EQ(found.ranked[1].effect->name, "squareness");
  EXPECT_EQ(found.ranked[1].rank, 2U);
  EXPECT_NEAR(found.ranked[1].gain_um, 1.0, 0.05);
  for (std::size_t k = 2; k < found.ranked.size(); ++k) EXPECT_EQ(found.ranked[k].rank, std::nullopt);
}

// Sigma of a gain is what the gain scatters by from one noise to another, within a factor of 2.
TEST(MachineErrors, SigmaOfAGainIsItsScatter) {
  made::ErrorTest test = made::noisy(made::full_turn());
  test.errors = {{"scale_mismatch", 8.0}};
  double sum = 0.0, squares = 0.0, sigmas = 0.0;
  constexpr int kTests = 20;
  for (int seed = 1; seed <= kTests; ++seed) {
    const RankedError first = machine_errors(made::both_runs(test, static_cast<std::uint64_t>(seed))).ranked.front();
    EXPECT_EQ(first.effect->name, "scale_mismatch");
    sum += first.gain_um;
    squares += first.gain_um * first.gain_um;
    sigmas += first.gain_sigma_um;
  }
  const double scatter = std::sqrt(squares / kTests - sum * sum / kTests / kTests);
  EXPECT_GT(sigmas / kTests, 0.5 * scatter);
  EXPECT_LT(sigmas / kTests, 2.0 * scatter);
}

// A full turn without noise: the instrument's estimator gives back the values, but for the far centre's second order.
TEST(MachineErrors, AsInstrumentAreTheValuesOfAFullTurn) {
  made::ErrorTest test = made::full_turn();
  test.errors = {{"squareness", 20.0},        {"scale_mismatch", 8.0},     {"straightness_a", -5.0},
                 {"servo_mismatch", 0.09},    {"backlash_a_pos", 2.0},     {"backlash_a_neg", 1.0},
                 {"lateral_play_b_pos", 1.7}, {"lateral_play_b_neg", 0.7}, {"sin_4_theta", 1.0},
                 {"offset_a_shift", 1.0},     {"global_scale", 3.0}};
  const MachineErrors found = machine_errors(made::both_runs(test));
  int compared = 0;
  for (const MachineError& row : found.errors) {
    if (row.name.starts_with("cubic_error")) {
      EXPECT_EQ(row.as_instrument, std::nullopt);
      continue;
    }
    // Of the radius' change 2.5 % are damped away, which the lateral plays take up.
    ASSERT_TRUE(row.as_instrument.has_value()) << row.name;
    EXPECT_NEAR(*row.as_instrument, test.of(row.name), row.name.starts_with("reversal") ? 0.3 : 0.1) << row.name;
    ++compared;
  }
  EXPECT_GE(compared, 25);
  double sum_percent = 0.0;
  std::size_t ranks = 0;
  for (const RankedError& one : found.ranked) {
    if (!one.as_instrument) continue;
    ++ranks;
    sum_percent += one.as_instrument->share_percent;
  }
  EXPECT_EQ(ranks, 13U);  // all but sin 4 theta and the cubic error
  EXPECT_NEAR(sum_percent, 100.0, 1e-9);
}

// An oval of 4 um and nothing else: 4 um of circularity, and nothing is left if it is mended.
TEST(MachineErrors, CircularityWithoutTheOnlyErrorIsNothing) {
  made::ErrorTest test = made::full_turn();
  test.errors = {{"scale_mismatch", 8.0}, {"global_scale", 7.0}};
  const MachineErrors found = without_prior(test);
  EXPECT_NEAR(found.circularity_um, 4.0, 0.01);
  EXPECT_EQ(found.ranked.front().effect->name, "scale_mismatch");
  EXPECT_NEAR(found.ranked.front().circularity_without_um, 0.0, 0.05);  // of curves at means over 0.4 deg
  EXPECT_NEAR(found.ranked.back().circularity_without_um, 4.0, 0.02);
}

// Errors added one by one: from what the circle leaves to what all leave, each time the one that lowers it most.
TEST(MachineErrors, WhatIsLeftFallsErrorByError) {
  made::ErrorTest test = made::noisy(made::full_turn());
  test.errors = {{"scale_mismatch", 8.0}, {"squareness", 20.0}, {"backlash_a_pos", 2.0}, {"backlash_a_neg", 2.0}};
  const MachineErrors found = machine_errors(made::both_runs(test, 2));
  // by hand: (mismatch / 4)^2 / 2 + (squareness R / 2)^2 / 2 + backlash^2 / 8 + noise^2 are 2 + 1.125 + 0.5 + 0.1
  EXPECT_NEAR(found.circle_rms_um, std::sqrt(3.7), 0.15);
  ASSERT_EQ(found.one_by_one.size(), 3U);
  EXPECT_EQ(found.one_by_one[0].effect->name, "scale_mismatch");
  EXPECT_NEAR(found.one_by_one[0].rms_um, std::sqrt(1.7), 0.15);
  EXPECT_EQ(found.one_by_one[1].effect->name, "squareness");
  EXPECT_NEAR(found.one_by_one[1].rms_um, std::sqrt(0.6), 0.15);
  EXPECT_EQ(found.one_by_one[2].effect->name, "backlash_a");
  EXPECT_NEAR(found.one_by_one[2].rms_um, std::sqrt(0.1), 0.05);
  EXPECT_NEAR(found.one_by_one[2].rms_um, found.residual_rms_um, 0.03);
}

TEST(MachineErrors, OfATraceAreThoseOfItsRecordings) {
  const std::vector<Recording> recordings = made::both_runs(made::noisy(made::full_turn()));
  const MachineErrors of_recordings = machine_errors(recordings);
  const MachineErrors of_trace = machine_errors_of_trace(trace_of(recordings));
  ASSERT_EQ(of_trace.errors.size(), of_recordings.errors.size());
  for (std::size_t k = 0; k < of_trace.errors.size(); ++k) {
    EXPECT_EQ(of_trace.errors[k].name, of_recordings.errors[k].name);
    EXPECT_EQ(of_trace.errors[k].value, of_recordings.errors[k].value);
    EXPECT_EQ(of_trace.errors[k].sigma, of_recordings.errors[k].sigma);
  }
}

}  // namespace
}  // namespace ballbar

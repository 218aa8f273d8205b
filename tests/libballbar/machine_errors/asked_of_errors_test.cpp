// What other parts ask of the errors: scales of the axes, the angle between them, curves.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "made_errors.hpp"

namespace ballbar {
namespace {

double value_of(const MachineErrors& found, const std::string& name) {
  for (const MachineError& row : found.errors) {
    if (row.name == name) return row.value;
  }
  ADD_FAILURE() << "no row " << name;
  return 0.0;
}

// 6 um longer on 150 mm is 40 ppm; a mismatch of 12 um over the diameter of 300 mm is 40 ppm between the axes.
TEST(AxisScales, AreScaleAndMismatchOverTheRadius) {
  made::ErrorTest test = made::full_turn();
  test.errors = {{"global_scale", 6.0}, {"scale_mismatch", 12.0}};
  const MachineErrors found = machine_errors(made::both_runs(test));
  const std::optional<AxisScales> scales = axis_scales(found, 150.0);
  ASSERT_TRUE(scales.has_value());
  EXPECT_NEAR(scales->a_ppm, 60.0, 0.1);
  EXPECT_NEAR(scales->b_ppm, 20.0, 0.1);
}

// Of independent scale and mismatch: variance s^2 / R^2 + m^2 / (4 R)^2, covariance s^2 / R^2 - m^2 / (4 R)^2.
TEST(AxisScales, CovarianceIsThatOfScaleAndMismatch) {
  MachineErrors found;
  found.errors = {{"global_scale", "um", 2.0, 0.3, nullptr},
                  {"scale_mismatch", "um", 1.0, 0.8, find_effect("scale_mismatch", Level::recording)}};
  found.covariance = Eigen::Vector2d(0.09, 0.64).asDiagonal();
  const std::optional<AxisScales> scales = axis_scales(found, 100.0);
  ASSERT_TRUE(scales.has_value());
  EXPECT_NEAR(scales->a_ppm, 22.5, 1e-9);
  EXPECT_NEAR(scales->b_ppm, 17.5, 1e-9);
  EXPECT_NEAR(scales->covariance(0, 0), 9.0 + 4.0, 1e-9);
  EXPECT_NEAR(scales->covariance(1, 1), 9.0 + 4.0, 1e-9);
  EXPECT_NEAR(scales->covariance(0, 1), 9.0 - 4.0, 1e-9);
}

TEST(AxisScales, AreNothingWhereTheReadingsDoNotTellThem) {
  MachineErrors found;
  found.errors = {{"global_scale", "um", 2.0, 0.3, nullptr}};
  found.covariance = Eigen::MatrixXd::Identity(1, 1);
  EXPECT_FALSE(axis_scales(found, 100.0).has_value());
  EXPECT_FALSE(squareness_of(found).has_value());
}

TEST(SquarenessOf, IsTheRowOfTheAngle) {
  made::ErrorTest test = made::full_turn();
  test.errors = {{"squareness", -31.0}};
  const std::optional<MachineError> angle = squareness_of(machine_errors(made::both_runs(test)));
  ASSERT_TRUE(angle.has_value());
  EXPECT_EQ(angle->name, "squareness");
  EXPECT_EQ(angle->unit, "um/m");
  EXPECT_NEAR(angle->value, -31.0, 0.01);
}

// Reading by reading: circle and curves are what was measured, but for what is left.
TEST(CurveOf, AllCurvesAndTheCircleAreTheDeviationLessTheResidual) {
  made::ErrorTest test = made::noisy(made::full_turn());
  test.errors = {{"squareness", 20.0},        {"backlash_b_pos", 3.0}, {"lateral_play_a_neg", 2.0},
                 {"cyclic_error_a_fwd", 2.0}, {"centre_a", 4.0},       {"radius_change", 2.0}};
  const std::vector<Recording> recordings = made::both_runs(test);
  const MachineErrors found = machine_errors(recordings);
  const std::vector<double> all = curve_of(found, nullptr, recordings);
  std::vector<double> sum(all.size(), 0.0);
  for (const RankedError& one : found.ranked) {
    bool in_the_fit = true;
    for (const FittedGain& gain : found.gains) {
      if (gain.effect == one.effect) in_the_fit = gain.in_the_fit;
    }
    const std::vector<double> curve = curve_of(found, one.effect, recordings);
    ASSERT_EQ(curve.size(), sum.size());
    for (std::size_t i = 0; in_the_fit && i < sum.size(); ++i) sum[i] += curve[i];
  }
  double squares = 0.0;
  std::size_t i = 0;
  for (const Recording& recording : recordings) {
    const double D = recording.direction == Direction::CCW ? 1.0 : -1.0;
    for (std::size_t k = 0; k < recording.length_mm.size(); ++k, ++i) {
      EXPECT_NEAR(sum[i], all[i], 1e-9);
      const double c = std::cos(recording.angle_rad[k]), s = std::sin(recording.angle_rad[k]);
      const double circle_um = value_of(found, "global_scale") + value_of(found, "centre_a") * c +
                               value_of(found, "centre_b") * s +
                               D / 2.0 *
                                   (value_of(found, "radius_change") + value_of(found, "offset_a_shift") * c +
                                    value_of(found, "offset_b_shift") * s);
      const double deviation_um = 1e3 * (recording.length_mm[k] - recording.nominal_length_mm);
      squares += std::pow(deviation_um - circle_um - all[i], 2);
    }
  }
  // Noise of 0.32 um. What is stated has the curves at means of half a degree.
  const double left_um = std::sqrt(squares / static_cast<double>(i));
  EXPECT_NEAR(left_um, std::hypot(0.3, 0.1), 0.05);
  EXPECT_NEAR(found.residual_rms_um, left_um, 0.02 * left_um);
}

// Of one effect by hand: a servo mismatch of 0.25 ms at 1000 mm/min, v / 2 sin 2 theta.
TEST(CurveOf, OneErrorIsItsFormula) {
  made::ErrorTest test = made::full_turn();
  test.errors = {{"servo_mismatch", 0.25}, {"squareness", 10.0}};
  const std::vector<Recording> recordings = made::both_runs(test);
  const MachineErrors found = machine_errors(recordings);
  const std::vector<double> curve = curve_of(found, find_effect("servo_mismatch", Level::recording), recordings);
  const std::size_t n = recordings[0].angle_rad.size();
  ASSERT_EQ(curve.size(), 2 * n);
  for (const std::size_t k : {std::size_t{100}, n / 3, n - 5}) {
    const double amplitude_um = 0.25 * 1000.0 / 60.0 / 2.0;
    EXPECT_NEAR(curve[k], amplitude_um * std::sin(2.0 * recordings[0].angle_rad[k]), 0.005);
    EXPECT_NEAR(curve[n + k], -amplitude_um * std::sin(2.0 * recordings[1].angle_rad[k]), 0.005);
  }
}

}  // namespace
}  // namespace ballbar

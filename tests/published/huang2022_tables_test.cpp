// Tables 1 and 2 of Huang, Li, Zhao 2022 (doi 10.19650/j.cnki.cjsi.J2209226) against the paper's own formulas: a
// spindle at 3000 rpm, one row every 15 min over 4 h.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/temperature/temperature.hpp"

namespace ballbar {
namespace {

struct Row {
  double mean_point_degC;
  double measured_dl_um;  // table 1
  double model_dl_um;     // table 1
  double clearance_um;    // table 2
  double formula_c_um;    // eq. 29 to 32 with eq. 21's dL, for the eye
};

constexpr std::array<Row, 17> kRows = {{
    {22.5, 0.0, 0.0, 0.0, 0.0},
    {23.2, 2.0, 1.57, 1.08, 0.41},
    {26.8, 10.0, 9.65, 3.21, 2.40},
    {28.5, 13.2, 13.46, 3.44, 3.28},
    {28.9, 13.9, 14.36, 3.81, 3.49},
    {29.2, 14.6, 15.03, 4.06, 3.64},
    {29.5, 15.3, 15.71, 4.16, 3.79},
    {29.7, 15.6, 16.16, 4.29, 3.89},
    {29.9, 16.2, 16.61, 4.33, 3.99},
    {30.7, 17.3, 18.50, 4.45, 4.38},
    {30.8, 18.1, 18.63, 4.56, 4.43},
    {31.0, 18.5, 19.07, 4.72, 4.53},
    {31.1, 19.0, 19.30, 4.91, 4.58},
    {31.2, 19.3, 19.52, 5.01, 4.62},
    {31.3, 19.5, 19.75, 5.07, 4.67},
    {31.4, 19.8, 19.97, 5.12, 4.72},
    {31.5, 20.1, 20.20, 5.14, 4.77},
}};
constexpr std::size_t kMisprint = 9;  // 30.7 degC

// Eq. 21 of the paper's spindle, section 4.2: alpha 13.6 ppm/K, L 165 mm, T0 22.5 degC.
double formula_dl_um(const Row& row) { return mean_point_elongation_um(13.6, 165.0, row.mean_point_degC - 22.5); }

// Eq. 29 to 32 of its bearing, 7010: D_w 10.319 mm, f 0.53.
double formula_c_um(double elongation_um) {
  const std::vector<double> time_s{0.0, 1.0}, axial_um{0.0, elongation_um}, parameters{1.0, 10.319, 0.53};
  EffectRows rows{time_s, {}};
  rows.inputs.emplace_back(axial_um);
  std::array<double, 2> values{};
  find_effect("bearing_clearance", Level::series)->evaluate(rows, parameters.data(), values.data(), nullptr);
  return values[1];
}

// 16 of 17 rows follow from alpha L (T - T0) to the printed digit. The row at 30.7 degC prints 18.50 where it gives
// 18.40; 18.50 would need 30.744 degC, which prints as 30.7, but every other row follows from T as printed.
TEST(Huang2022Table1, ModelFollowsFromEq21InAllRowsButOne) {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    const double from_formula_um = formula_dl_um(kRows[i]);
    if (i == kMisprint) {
      EXPECT_NEAR(from_formula_um, 18.40, 0.005);
      EXPECT_DOUBLE_EQ(kRows[i].model_dl_um, 18.50);
    } else {
      EXPECT_NEAR(from_formula_um, kRows[i].model_dl_um, 0.005 + 1e-9) << kRows[i].mean_point_degC << " degC";
    }
  }
}

// The clearance does not follow from eq. 29 to 32 with the stated D_w, f and dL: the table is above the formula in
// every row, by 0.813 um at 26.8 degC, 0.37 um at the end and 0.07 um at least (30.7 degC).
TEST(Huang2022Table2, ClearanceDoesNotFollowFromEq29To32) {
  double largest_um = 0.0, least_um = 1.0;
  std::size_t where = 0;
  for (std::size_t i = 1; i < kRows.size(); ++i) {
    const double c_um = formula_c_um(formula_dl_um(kRows[i]));
    EXPECT_NEAR(c_um, kRows[i].formula_c_um, 0.005) << kRows[i].mean_point_degC << " degC";
    const double above_um = kRows[i].clearance_um - c_um;
    if (above_um > largest_um) where = i;
    largest_um = std::max(largest_um, above_um);
    least_um = std::min(least_um, above_um);
  }
  EXPECT_NEAR(largest_um, 0.813, 0.0005);
  EXPECT_DOUBLE_EQ(kRows[where].mean_point_degC, 26.8);
  EXPECT_NEAR(least_um, 0.068, 0.0005);
  EXPECT_NEAR(formula_c_um(20.20), 4.77, 0.005) << "table 2 prints 5.14";
}

// No factor explains it: the ratio of table to formula is 2.67 in the first row and 1.02 to 1.12 from 45 min on. The
// measured elongation does not either: 2.0 um give 0.52 um for the printed 1.08.
TEST(Huang2022Table2, IsNoMultipleOfTheFormula) {
  EXPECT_NEAR(kRows[1].clearance_um / formula_c_um(formula_dl_um(kRows[1])), 2.67, 0.01);
  double lowest = 10.0, highest = 0.0;
  for (std::size_t i = 3; i < kRows.size(); ++i) {
    const double ratio = kRows[i].clearance_um / formula_c_um(formula_dl_um(kRows[i]));
    lowest = std::min(lowest, ratio);
    highest = std::max(highest, ratio);
  }
  EXPECT_NEAR(lowest, 1.02, 0.01);
  EXPECT_NEAR(highest, 1.12, 0.01);
  EXPECT_NEAR(formula_c_um(kRows[1].measured_dl_um), 0.52, 0.01);
}

// What is left of the measured column of table 1 by least squares on some columns.
struct Rest {
  Eigen::VectorXd coefficients;
  double sum_of_squares_um2 = 0.0;
  double largest_um = 0.0;
};

Eigen::VectorXd measured_um() {
  Eigen::VectorXd y(17);
  for (Eigen::Index i = 0; i < 17; ++i) y[i] = kRows[static_cast<std::size_t>(i)].measured_dl_um;
  return y;
}

Rest rest(const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd coefficients = columns.colPivHouseholderQr().solve(measured_um());
  const Eigen::VectorXd left = measured_um() - columns * coefficients;
  return {coefficients, left.squaredNorm(), left.cwiseAbs().maxCoeff()};
}

// An effect with gain 1 over the rows, its input the temperature of the mean-value point or none.
Eigen::VectorXd effect_column(std::string_view name, std::vector<double> parameters) {
  std::vector<double> time_s, temperature_degC;
  for (const Row& row : kRows) {
    time_s.push_back(900.0 * static_cast<double>(time_s.size()));
    temperature_degC.push_back(row.mean_point_degC);
  }
  const Effect& effect = *find_effect(name, Level::series);
  EffectRows rows{time_s, {}};
  if (!effect.inputs.empty()) rows.inputs.emplace_back(temperature_degC);
  parameters.insert(parameters.begin(), 1.0);
  Eigen::VectorXd values(17);
  effect.evaluate(rows, parameters.data(), values.data(), nullptr);
  return values;
}

// The paper states a largest residual of 1.2 um. It is 17.3 against the misprinted 18.50; against the formula's 18.40
// it is 1.10 um, and 0.57 um in the other rows.
TEST(Huang2022Table1, LargestResidualIsInTheMisprintedRow) {
  double printed_um = 0.0, formula_um = 0.0, others_um = 0.0, sum_of_squares_um2 = 0.0;
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    const double left_um = std::abs(kRows[i].measured_dl_um - formula_dl_um(kRows[i]));
    printed_um = std::max(printed_um, std::abs(kRows[i].measured_dl_um - kRows[i].model_dl_um));
    formula_um = std::max(formula_um, left_um);
    if (i != kMisprint) others_um = std::max(others_um, left_um);
    sum_of_squares_um2 += left_um * left_um;
  }
  EXPECT_NEAR(printed_um, 1.20, 1e-9);
  EXPECT_NEAR(formula_um, 1.1008, 1e-9);
  EXPECT_NEAR(others_um, 0.574, 1e-9);
  EXPECT_NEAR(std::sqrt(sum_of_squares_um2 / 17.0), 0.452, 0.0005);
}

// A fitted gain is 2.196 um/K, 2.1 % below alpha L = 2.244, and explains 59 % of the residual's squares.
TEST(Huang2022Table1, FittedGainLeavesLess) {
  const Eigen::VectorXd rise_K = effect_column("expansion", {});
  const Rest with_formula{{}, (measured_um() - 2.244 * rise_K).squaredNorm(), 0.0};
  const Rest fitted = rest(rise_K);
  EXPECT_NEAR(fitted.coefficients[0], 2.196, 0.0005);
  EXPECT_NEAR(fitted.largest_um, 0.707, 0.0005);
  EXPECT_NEAR(1.0 - fitted.sum_of_squares_um2 / with_formula.sum_of_squares_um2, 0.592, 0.0005);
}

// The measured column runs ahead of the temperature (too long for it at 15 and 30 min, too short after 45 min), so a
// lag of the same sensor only makes it worse.
TEST(Huang2022Table1, LagOfTheSensorExplainsNothing) {
  double before = rest(effect_column("expansion", {})).sum_of_squares_um2;
  for (const double tau_s : {1.0, 10.0, 60.0, 180.0, 600.0, 1800.0, 5400.0}) {
    const double after = rest(effect_column("lagged_expansion", {tau_s})).sum_of_squares_um2;
    EXPECT_GT(after, before) << tau_s << " s";
    before = after;
  }
}

// A second body or settling beside the gain lowers the squares by 14 and 15 % for two more parameters:
// F(2, 14) = 1.12 and 1.27, far below 3.74, its 95 % point. 17 points show no more than the gain.
TEST(Huang2022Table1, SecondTermIsNotShown) {
  const Eigen::VectorXd rise_K = effect_column("expansion", {});
  const double alone = rest(rise_K).sum_of_squares_um2;
  const auto best_f = [&](std::string_view name) {
    double least = alone;
    for (double tau_s = 60.0; tau_s < 2e5; tau_s *= 1.1) {
      Eigen::MatrixXd columns(17, 2);
      columns << rise_K, effect_column(name, {tau_s});
      least = std::min(least, rest(columns).sum_of_squares_um2);
    }
    return ((alone - least) / 2.0) / (least / 14.0);
  };
  EXPECT_NEAR(best_f("lagged_expansion"), 1.12, 0.02);
  EXPECT_NEAR(best_f("settling"), 1.27, 0.02);
}

}  // namespace
}  // namespace ballbar

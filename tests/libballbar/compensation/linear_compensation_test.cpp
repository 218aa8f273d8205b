#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr Increment kTenth{0.1, false};

// z = 2 um/K (T_a - T_a0)
Model of_T_a() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_a_degC"})};
  model.terms[0].settings[0].start = 2.0;
  model.terms[0].settings[0].held = true;
  model.constant_um = 0.0;
  return model;
}

// Two runs in which T_a rises by 0, 1, 2 K and z by 2 um/K of it, from zeros of their own. T_b rises as T_a in the
// first run, and twice as much in the second. T_c stands still.
Series two_runs() {
  return {{0.0, 10.0, 20.0, 0.0, 10.0, 20.0},
          {{"T_a_degC", Role::bearing, {20.0, 21.0, 22.0, 20.0, 21.0, 22.0}},
           {"T_b_degC", Role::bearing, {20.0, 21.0, 22.0, 20.0, 22.0, 24.0}},
           {"T_c_degC", Role::ambient, {18.0, 18.0, 18.0, 18.0, 18.0, 18.0}},
           {"z_um", Role::measured, {5.0, 7.0, 9.0, -3.0, -1.0, 1.0}}}};
}

// b = (1 2 + 2 2) / (1 1 + 2 2) = 1.2 um/K; without the first run 1, without the second 2, so that
// sigma^2 = 1/2 (0.5^2 + 0.5^2) = 0.5^2. Left by 1.2 um/K: 0.8 r and -0.4 r of a rise r of T_a = 1, 2 K:
// sqrt((0.64 + 2.56 + 0.16 + 0.64) / 4) = 1. Left out: r by the slope of 1, -2 r by that of 2:
// sqrt((1 + 4 + 4 + 16) / 4) = 2.5. Before: 2 r, sqrt(10).
TEST(LinearCompensation, IsLeastSquaresFromTheZerosAndJudgedOnRunsLeftOut) {
  const Simplification result =
      simplified(of_T_a(), two_runs(), std::vector<std::string>{"T_b_degC", "T_c_degC"}, 1, 2.0, kTenth);
  ASSERT_EQ(result.line.sensors.size(), 1U);
  const SensorSlope& sensor = result.line.sensors[0];
  EXPECT_EQ(sensor.column, "T_b_degC");
  EXPECT_NEAR(sensor.slope_um_per_K, 1.2, 1e-12);
  EXPECT_NEAR(sensor.sigma_um_per_K, 0.5, 1e-12);
  EXPECT_EQ(sensor.zero, 20.0);
  EXPECT_EQ(sensor.low, 12.0);  // 20 to 24 degC, and twice that at either end
  EXPECT_EQ(sensor.high, 32.0);
  EXPECT_EQ(result.runs, 2U);
  EXPECT_EQ(result.rows, 6U);
  EXPECT_EQ(result.fitted.values, 4U);
  EXPECT_NEAR(result.fitted.line.before_um, std::sqrt(10.0), 1e-12);
  EXPECT_NEAR(result.fitted.line.after_um, 1.0, 1e-12);
  EXPECT_NEAR(result.fitted.model.after_um, 0.0, 1e-12);
  EXPECT_NEAR(result.fitted.largest_line_um, 1.6, 1e-12);
  ASSERT_TRUE(result.left_out.has_value());
  EXPECT_NEAR(result.left_out->line.after_um, 2.5, 1e-12);
  EXPECT_NEAR(result.left_out->largest_line_um, 4.0, 1e-12);
  EXPECT_EQ(result.left_out->beyond, 0U);
  EXPECT_NEAR(result.from_model_um, std::sqrt(4.0 / 6.0), 1e-12);  // the rows at the zeros are among its rows
}

// Without a margin the second run, left out, is at 24 degC beyond the 22 degC of the first, whose slope of 2 um/K then
// makes 4 um of 8: left are -2 r at 22 degC, and 4 - 4 = 0.
TEST(LinearCompensation, CountsWhatIsBeyondItsEnds) {
  const Simplification result = simplified(of_T_a(), two_runs(), std::vector<std::string>{"T_b_degC"}, 1, 0.0, kTenth);
  EXPECT_EQ(result.left_out->beyond, 1U);
  EXPECT_NEAR(result.left_out->line.after_um, std::sqrt((1.0 + 4.0 + 4.0 + 0.0) / 4.0), 1e-12);
  EXPECT_EQ(result.fitted.beyond, 0U);
}

TEST(LinearCompensation, TakesTheSensorThatLeavesLeast) {
  const Simplification result =
      simplified(of_T_a(), two_runs(), std::vector<std::string>{"T_c_degC", "T_b_degC", "T_a_degC"}, 1, 0.0, kTenth);
  EXPECT_EQ(result.line.sensors[0].column, "T_a_degC");
  EXPECT_NEAR(result.line.sensors[0].slope_um_per_K, 2.0, 1e-12);
}

// z = 2 T_a, T_a = T_1 + T_2 / 4: slopes of 2 and 0.5 um/K. One record: what is left out are its last two fifths.
TEST(LinearCompensation, TakesTwoSensorsOfOneRecord) {
  Series data;
  std::vector<double> first, second, a, z;
  for (int i = 0; i < 50; ++i) {
    data.time_s.push_back(10.0 * i);
    first.push_back(20.0 + i % 7);
    second.push_back(25.0 + i % 5);
    a.push_back(first.back() + second.back() / 4.0);
    z.push_back(2.0 * (a.back() - a.front()) + (i == 45 ? 3.0 : 0.0));  // measured, not predicted
  }
  data.columns = {{"T_a_degC", Role::measured, a},
                  {"T_1_degC", Role::bearing, first},
                  {"T_2_degC", Role::bearing, second},
                  {"z_um", Role::measured, z}};
  const Simplification result =
      simplified(of_T_a(), data, std::vector<std::string>{"T_1_degC", "T_2_degC"}, 2, 0.0, {0.5, false});
  EXPECT_NEAR(result.line.sensors[0].slope_um_per_K, 2.0, 1e-12);
  EXPECT_NEAR(result.line.sensors[1].slope_um_per_K, 0.5, 1e-12);
  EXPECT_NEAR(result.line.sensors[0].sigma_um_per_K, 0.0, 1e-9);
  EXPECT_EQ(result.runs, 1U);
  EXPECT_EQ(result.left_out->values, 20U);
  EXPECT_NEAR(result.left_out->line.after_um, 3.0 / std::sqrt(20.0), 1e-9);
}

// K = 1.2 um/K (T - 22) from 19.2 to 28.8 degC.
TEST(LinearCompensation, StopsAtItsEndsAndIsWholeIncrements) {
  LinearCompensation line{{{"T_b_degC", 1.2, 0.0, 22.0, 19.2, 28.8}}, {0.5, false}};
  const auto at = [&](double reading) { return error_um(line, std::vector<double>{reading}); };
  EXPECT_EQ(at(22.0), 0.0);
  EXPECT_EQ(at(23.0), 1.0);    // 1.2
  EXPECT_EQ(at(23.4), 1.5);    // 1.68
  EXPECT_EQ(at(21.0), -1.0);   // -1.2
  EXPECT_EQ(at(40.0), 8.0);    // 8.16
  EXPECT_EQ(at(-40.0), -3.5);  // -3.36
  line.increment.toward_zero = true;
  EXPECT_EQ(at(23.4), 1.5);
  EXPECT_EQ(at(20.6), -1.5);  // -1.68
  EXPECT_EQ(at(-40.0), -3.0);
}

TEST(LinearCompensation, SaysWhatCannotBeALine) {
  const auto expect_error = [](const Model& model, const Series& data, std::vector<std::string> sensors,
                               std::size_t count, const std::string& message) {
    try {
      simplified(model, data, sensors, count, 0.1, kTenth);
      ADD_FAILURE() << "expected: " << message;
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), message);
    }
  };
  const std::vector<std::string> b{"T_b_degC"};
  Model two = of_T_a();
  two.targets = {"z_um", "y_um"};
  expect_error(two, two_runs(), b, 1, "expected a model of one target, found 2: each axis has a line of its own.");
  Model angle = of_T_a();
  angle.targets = {"z_urad"};
  expect_error(angle, two_runs(), b, 1, "expected a target in um, which moves an axis, found z_urad.");
  Model other = of_T_a();
  other.targets = {"zz_um"};
  expect_error(other, two_runs(), b, 1, "expected the column zz_um, found none; the nearest is z_um.");
  expect_error(of_T_a(), two_runs(), {"T_d_degC"}, 1,
               "expected the column T_d_degC, found none; the nearest is T_a_degC.");
  expect_error(of_T_a(), two_runs(), {"T_c_degC"}, 1,
               "expected 1 temperature that moves while z_um was measured, found none.");
  expect_error(of_T_a(), two_runs(), {"T_b_degC", "T_c_degC"}, 2,
               "expected 2 temperatures, each in its own way, that move while z_um was measured, found none.");
  expect_error(of_T_a(), two_runs(), b, 0, "expected 1 to 3 sensors, found 0.");
  expect_error(of_T_a(), two_runs(), b, 4, "expected 1 to 3 sensors, found 4.");
  Series gap = two_runs();
  gap.columns[1].values[4] = kGap;
  expect_error(of_T_a(), gap, b, 1, "expected a value of T_b_degC at every time, found a gap at 10 s.");
  Series unmeasured = two_runs();
  unmeasured.columns[3].values = {1.0, kGap, kGap, kGap, kGap, 2.0};
  expect_error(of_T_a(), unmeasured, b, 1, "expected at least two values of z_um in a run, found 1.");
}

}  // namespace
}  // namespace ballbar

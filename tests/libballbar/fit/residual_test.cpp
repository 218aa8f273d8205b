// Regimes, where a model fails, and whether what is left is noise.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "ballbar/fit/fit.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

std::vector<double> minutes(std::size_t n) {
  std::vector<double> time_s(n);
  for (std::size_t i = 0; i < n; ++i) time_s[i] = 60.0 * static_cast<double>(i);
  return time_s;
}

// One row a minute: 30 min rest, 2 h at 8000, 1 h at 12000, 3 h at 4000, 3 h rest.
Column duty() {
  Column speed{"speed_rpm", Role::speed, {}};
  const auto hold = [&](double rpm, std::size_t rows) { speed.values.insert(speed.values.end(), rows, rpm); };
  hold(0.0, 30);
  hold(8000.0, 120);
  hold(12000.0, 60);
  hold(4000.0, 180);
  hold(0.0, 180);
  return speed;
}

// Rows of a regime in one stretch.
struct Stretch {
  Regime regime;
  std::size_t rows;
};

void expect_stretches(const std::vector<Regime>& found, const std::vector<Stretch>& expected) {
  std::size_t row = 0;
  for (const Stretch& stretch : expected) {
    for (std::size_t i = 0; i < stretch.rows; ++i, ++row) {
      ASSERT_LT(row, found.size());
      ASSERT_EQ(found[row], stretch.regime) << "row " << row << ": " << name_of(found[row]);
    }
  }
  EXPECT_EQ(row, found.size());
}

TEST(Regimes, of_a_duty_cycle) {
  expect_stretches(regimes(minutes(570), duty()), {{Regime::standstill, 30},
                                                   {Regime::after_change, 10},
                                                   {Regime::warming, 50},
                                                   {Regime::steady, 60},
                                                   {Regime::after_change, 10},
                                                   {Regime::warming, 50},
                                                   {Regime::after_change, 10},
                                                   {Regime::cooling, 110},
                                                   {Regime::steady, 60},
                                                   {Regime::after_change, 10},
                                                   {Regime::cooling, 110},
                                                   {Regime::standstill, 60}});
}

TEST(Regimes, a_record_that_begins_at_speed_begins_with_warming) {
  Column speed{"speed_rpm", Role::speed, std::vector<double>(100, -3000.0)};
  expect_stretches(regimes(minutes(100), speed), {{Regime::warming, 60}, {Regime::steady, 40}});
}

// Running from minute 20 on, with a rest of 2 min for a test every 8 min: one stretch.
TEST(Regimes, a_short_rest_for_a_test_does_not_count) {
  Column speed{"speed_rpm", Role::speed, std::vector<double>(136, 3000.0)};
  for (std::size_t row = 0; row < 136; ++row) {
    if (row < 20 || row % 8 < 2) speed.values[row] = 0.0;
  }
  // 20 to 23 min run before the first test at 24 min.
  expect_stretches(regimes(minutes(136), speed),
                   {{Regime::standstill, 20}, {Regime::after_change, 10}, {Regime::warming, 50}, {Regime::steady, 56}});
}

TEST(Regimes, none_without_a_speed) {
  Column speed{"speed_rpm", Role::speed, std::vector<double>(100, std::numeric_limits<double>::quiet_NaN())};
  EXPECT_TRUE(regimes(minutes(100), speed).empty());
  EXPECT_TRUE(regimes({}, {"speed_rpm", Role::speed, {}}).empty());
}

Fit fit_with(const std::vector<double>& residual_um, const Noise& noise = {1.0, 0.0, 0.0, 0.0}) {
  Fit fit;
  fit.target = "x_um";
  fit.time_s = minutes(residual_um.size());
  fit.residual_um = residual_um;
  for (std::size_t i = 0; i < residual_um.size(); ++i) {
    fit.row.push_back(i);
    fit.rmse_um += residual_um[i] * residual_um[i] / static_cast<double>(residual_um.size());
  }
  fit.rmse_um = std::sqrt(fit.rmse_um);
  fit.noise = noise;
  return fit;
}

Series series_with(std::size_t n, const std::vector<Column>& columns) { return {minutes(n), columns, std::nullopt}; }

std::vector<Misfit> of(const std::vector<Misfit>& where, std::string_view what) {
  std::vector<Misfit> result;
  for (const Misfit& misfit : where) {
    if (misfit.what == what) result.push_back(misfit);
  }
  return result;
}

// 20 rows, 2 um in the first 4 and 1 um in the rest: squares 16 of 32; tenths of 19 min: rows 0 and 1 ... are too few,
// but with 40 rows there are 4 in each.
TEST(WhereItFails, tenths_of_the_time_by_hand) {
  std::vector<double> residual(40, 1.0);
  for (std::size_t i = 0; i < 4; ++i) residual[i] = i % 2 == 0 ? 3.0 : -1.0;
  const std::vector<Misfit> time = of(where_it_fails(fit_with(residual), series_with(40, {})), "time");
  ASSERT_EQ(time.size(), 10U);
  EXPECT_EQ(time[0].from, "0 min");
  EXPECT_EQ(time[0].to, "3.9 min");
  EXPECT_EQ(time[0].n, 4U);
  EXPECT_NEAR(time[0].bias_um, 1.0, 1e-14);
  EXPECT_NEAR(time[0].bias_sigma_um, 0.5, 1e-14) << "1 um white, 4 rows";
  EXPECT_NEAR(time[0].rmse_um, std::sqrt(5.0), 1e-14);
  EXPECT_NEAR(time[0].share, 20.0 / 56.0, 1e-14);
  std::size_t rows = 0;
  double share = 0.0;
  for (const Misfit& misfit : time) {
    rows += misfit.n;
    share += misfit.share;
  }
  EXPECT_EQ(rows, 40U);
  EXPECT_NEAR(share, 1.0, 1e-14);
}

// Regimes of the duty cycle: rows 90, 40, 100, 120, 220; all residuals 1 um but 3 um after a change.
TEST(WhereItFails, regimes_by_hand) {
  const std::vector<Regime> regime = regimes(minutes(570), duty());
  std::vector<double> residual;
  for (const Regime each : regime) residual.push_back(each == Regime::after_change ? -3.0 : 1.0);
  const std::vector<Misfit> found = of(where_it_fails(fit_with(residual), series_with(570, {duty()})), "regime");
  ASSERT_EQ(found.size(), 5U);
  EXPECT_EQ(found[1].from, "after a change of speed");
  EXPECT_EQ(found[1].n, 40U);
  EXPECT_NEAR(found[1].bias_um, -3.0, 1e-12);
  EXPECT_NEAR(found[1].share, 360.0 / 890.0, 1e-12);
  EXPECT_EQ(found[0].n, 90U);
  EXPECT_EQ(found[2].n, 100U);
  EXPECT_EQ(found[3].n, 120U);
  EXPECT_EQ(found[4].n, 220U);
}

// q = 1, a decay of 1/2 a minute: the mean of 3 rows in a row has (3 + 2 (1/2 + 1/2 + 1/4)) / 9 = 5.5 / 9.
TEST(WhereItFails, sigma_of_the_bias_knows_the_memory) {
  const Fit fit = fit_with(std::vector<double>(30, 1.0), {0.0, 1.0, 60.0 / std::log(2.0), 0.0});
  const std::vector<Misfit> time = of(where_it_fails(fit, series_with(30, {})), "time");
  ASSERT_FALSE(time.empty());
  EXPECT_EQ(time[0].n, 3U);
  EXPECT_NEAR(time[0].bias_sigma_um, std::sqrt(5.5) / 3.0, 1e-12);
}

// Values 0 ... 99: fifths of 20 rows (the bounds at 0, 19, 39, 59, 79, 99); three values: a group each; a constant:
// none.
TEST(WhereItFails, fifths_of_signals) {
  Column rising{"T_air_degC", Role::ambient, {}}, three{"P_W", Role::load, {}};
  for (int i = 0; i < 100; ++i) {
    rising.values.push_back(i);
    three.values.push_back(i % 3);
  }
  const Column constant{"T_oil_degC", Role::coolant, std::vector<double>(100, 20.0)};
  const Column target{"x_um", Role::measured, rising.values};
  const std::vector<Misfit> where =
      where_it_fails(fit_with(std::vector<double>(100, 1.0)), series_with(100, {rising, three, constant, target}));
  const std::vector<Misfit> fifths = of(where, "T_air_degC");
  ASSERT_EQ(fifths.size(), 5U);
  EXPECT_EQ(fifths[0].from, "0 degC");
  EXPECT_EQ(fifths[0].to, "19 degC");
  EXPECT_EQ(fifths[0].n, 19U);
  EXPECT_EQ(fifths[4].n, 21U);
  const std::vector<Misfit> values = of(where, "P_W");
  ASSERT_EQ(values.size(), 3U);
  EXPECT_EQ(values[2].from, "2 W");
  EXPECT_EQ(values[2].to, "2 W");
  EXPECT_TRUE(of(where, "T_oil_degC").empty());
  EXPECT_TRUE(of(where, "x_um").empty());
}

// Readings every 5 deg CCW and back CW: 6 in 30 deg, 18 in a quadrant; -10 deg is 350 deg.
TEST(WhereItFails, angle_and_quadrant_of_each_direction) {
  Column angle{"angle_rad", Role::event, {}}, direction{"direction", Role::event, {}};
  std::vector<double> residual;
  for (const double way : {1.0, -1.0}) {
    for (int i = 0; i < 72; ++i) {
      angle.values.push_back(rad_from_deg(way * (5.0 * i + 2.5)));
      direction.values.push_back(way);
      residual.push_back(way > 0.0 && i >= 18 && i < 36 ? 4.0 : 0.0);
    }
  }
  const std::vector<Misfit> where = where_it_fails(fit_with(residual), series_with(144, {angle, direction}));
  EXPECT_EQ(of(where, "angle, CCW").size(), 12U);
  EXPECT_EQ(of(where, "angle, CW").size(), 12U);
  const std::vector<Misfit> quadrant = of(where, "quadrant, CCW");
  ASSERT_EQ(quadrant.size(), 4U);
  EXPECT_EQ(quadrant[1].from, "90 deg");
  EXPECT_EQ(quadrant[1].n, 18U);
  EXPECT_NEAR(quadrant[1].share, 1.0, 1e-14);
}

std::vector<double> white(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values(n);
  for (double& value : values) value = normal(random);
  return values;
}

// Of 400 white residuals p is below 0.1 in 40 +- 6 and below 0.5 in 200 +- 10: bounds are 4 of these. 503 is a prime:
// the length is cut.
TEST(Whiteness, of_white_residuals_p_is_uniform) {
  for (const std::size_t n : {std::size_t{40}, std::size_t{503}}) {
    int tenth = 0, half = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      const double p = whiteness(fit_with(white(n, 100 + seed))).p;
      tenth += p < 0.1 ? 1 : 0;
      half += p < 0.5 ? 1 : 0;
    }
    EXPECT_NEAR(tenth, 40, 24);
    EXPECT_NEAR(half, 200, 40);
  }
}

// cos(2 pi 5 i / 40): all power at j = 5 of m = 19. C jumps from 0 to 1 there: D = max(4 / 18, 1 - 4 / 18).
TEST(Whiteness, distance_of_a_pure_tone_by_hand) {
  std::vector<double> residual(40);
  for (std::size_t i = 0; i < 40; ++i) residual[i] = std::cos(2.0 * kPi * 5.0 * static_cast<double>(i) / 40.0);
  const Whiteness found = whiteness(fit_with(residual));
  EXPECT_NEAR(found.periodogram_distance, 14.0 / 18.0, 1e-12);
  EXPECT_LT(found.p, 1e-6);
  ASSERT_EQ(found.autocorrelation.size(), 10U);
  // sum of cos a cos(a + pi / 4) over rows 1 ... 39, over 20: (20 cos(pi / 4) - cos(0) cos(-pi / 4)) / 20
  EXPECT_NEAR(found.autocorrelation[0], std::cos(kPi / 4.0) * 19.0 / 20.0, 1e-12);
}

// AR(1), phi = 0.9: not white as it is, white when whitened by its own noise.
TEST(Whiteness, is_judged_after_whitening) {
  std::vector<double> residual = white(600, 7);
  for (std::size_t i = 1; i < residual.size(); ++i) {
    residual[i] = 0.9 * residual[i - 1] + std::sqrt(1.0 - 0.81) * residual[i];
  }
  EXPECT_LT(whiteness(fit_with(residual)).p, 1e-6);
  EXPECT_GT(whiteness(fit_with(residual, {0.0, 1.0, -60.0 / std::log(0.9), 0.0})).p, 0.01);
}

TEST(Whiteness, few_rows_say_nothing) {
  EXPECT_EQ(whiteness(fit_with(std::vector<double>(15, 1.0))).p, 1.0);
  EXPECT_EQ(whiteness(fit_with({})).p, 1.0);
  EXPECT_EQ(whiteness(fit_with(std::vector<double>(64, 0.0))).p, 1.0);
}

// Rounding of a perfect fit: a tone of 1e-10 um is no misfit.
TEST(Whiteness, of_a_perfect_fit_nothing_is_left) {
  std::vector<double> residual(100);
  for (std::size_t i = 0; i < 100; ++i) residual[i] = 1e-10 * std::sin(0.3 * static_cast<double>(i));
  EXPECT_EQ(whiteness(fit_with(residual)).p, 1.0);
  for (double& r : residual) r *= 1000.0;
  EXPECT_LT(whiteness(fit_with(residual)).p, 0.001);
}

// Two of 40 rows are 100 um off and discounted: the others have 1 um, tenths of 4 rows but for those two with 3, and no
// tone of the two is left.
TEST(WhereItFails, does_not_count_what_was_discounted) {
  std::vector<double> residual = white(40, 3), with_outliers = residual;
  with_outliers[1] = with_outliers[21] = 100.0;
  Fit fit = fit_with(with_outliers);
  fit.discounted = {1, 21};
  std::vector<double> kept = residual;
  kept.erase(kept.begin() + 21);
  kept.erase(kept.begin() + 1);
  double squares = 0.0;
  for (const double r : kept) squares += r * r;
  const std::vector<Misfit> time = of(where_it_fails(fit, series_with(40, {})), "time");
  ASSERT_EQ(time.size(), 10U);
  EXPECT_EQ(time[0].n, 3U);
  EXPECT_EQ(time[1].n, 4U);
  EXPECT_NEAR(time[0].share, (kept[0] * kept[0] + kept[1] * kept[1] + kept[2] * kept[2]) / squares, 1e-12);
  EXPECT_EQ(whiteness(fit).p, whiteness(fit_with(kept)).p);
}

// 0.1 um to and fro, and -3 um in 40 of 570 rows: squares 5.7 + 360 of which 360.4 are there.
TEST(WorstPlace, of_a_model_that_fails) {
  const std::vector<Regime> regime = regimes(minutes(570), duty());
  std::vector<double> residual(570);
  for (std::size_t i = 0; i < residual.size(); ++i) {
    residual[i] = (i % 2 == 0 ? 0.1 : -0.1) + (regime[i] == Regime::after_change ? -3.0 : 0.0);
  }
  const Fit fit = fit_with(residual, {0.8, 0.0, 0.0, 0.0});
  const std::optional<Misfit> worst = worst_place(fit, where_it_fails(fit, series_with(570, {duty()})));
  ASSERT_TRUE(worst.has_value());
  EXPECT_EQ(worst->what, "regime");
  EXPECT_EQ(worst->from, "after a change of speed");
  EXPECT_EQ(worst->n, 40U);
  EXPECT_EQ(residual_nature(fit, whiteness(fit)).kind, ResidualKind::slow_not_noise);
}

TEST(WorstPlace, none_of_a_model_that_is_adequate) {
  const Fit fit = fit_with(white(400, 9));
  EXPECT_FALSE(worst_place(fit, where_it_fails(fit, series_with(400, {}))).has_value());
  EXPECT_FALSE(worst_place(fit, {}).has_value());
  EXPECT_EQ(residual_nature(fit, Whiteness{{}, 0.05, 0.42}).kind, ResidualKind::noise);
}

TEST(ResidualNature, of_slow_noise_and_of_few_readings) {
  const ResidualNature slow =
      residual_nature(fit_with(white(400, 9), {0.5, 1.0, 2100.0, 0.0}), Whiteness{{}, 0.05, 0.42});
  EXPECT_EQ(slow.kind, ResidualKind::slow);
  EXPECT_EQ(slow.correlation_time_s, 2100.0);
  EXPECT_EQ(residual_nature(fit_with({1.0, -1.0, 1.0, -1.0}), {}).kind, ResidualKind::too_few);
}

}  // namespace
}  // namespace ballbar

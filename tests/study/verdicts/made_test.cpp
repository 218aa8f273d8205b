// The study's own code held to formulas, to the covariance of its noise, and to what the catalogue says in words.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <set>

#include "cells.hpp"
#include "outside.hpp"
#include "physics.hpp"
#include "rivals.hpp"
#include "scene.hpp"

namespace ballbar::verdicts {
namespace {

Track step_at(std::size_t at_s, std::size_t length, double height) {
  Track track(length, 0.0);
  std::fill(track.begin() + static_cast<std::ptrdiff_t>(at_s), track.end(), height);
  return track;
}

// After a step at 100 s: 1 - exp(-(t - 100) / tau).
TEST(Physics, LowPassFollowsAStepAsTheFormulaSays) {
  const Track slow = low_pass(step_at(100, 2000, 3.0), 400.0);
  for (const std::size_t t : {50U, 100U, 101U, 500U, 1999U}) {
    const double since_s = std::max(0.0, static_cast<double>(t) - 100.0);
    EXPECT_NEAR(slow[t], 3.0 * (1.0 - std::exp(-since_s / 400.0)), 1e-12) << t;
  }
}

// 8 krpm to the 5/3 is 32; the stop at 1000 s is followed with the other time constant.
TEST(Physics, TwoLagsChangeWhereTheSpindleStops) {
  Track speed = step_at(0, 3000, 8000.0);
  speed[0] = 0.0;
  std::fill(speed.begin() + 1000, speed.end(), 0.0);
  const Track heat = heat_with_two_lags(speed, 5.0 / 3.0, 200.0, 900.0);
  EXPECT_NEAR(heat[601], 32.0 * (1.0 - std::exp(-3.0)), 1e-9);
  EXPECT_NEAR(heat[1900], heat[1000] * std::exp(-1.0), 1e-9);
}

// Up by 5, down by 5, half width 1: behind by 1 on the way up, ahead by 1 on the way down.
TEST(Physics, PlayIsALoop) {
  Track signal;
  for (int i = 0; i <= 10; ++i) signal.push_back(20.0 + 5.0 - std::abs(5.0 - i));
  const Track back = held_back(signal, 1.0);
  EXPECT_DOUBLE_EQ(back[0], 0.0);
  EXPECT_DOUBLE_EQ(back[5], -1.0);
  EXPECT_DOUBLE_EQ(back[6], 0.0);
  EXPECT_DOUBLE_EQ(back[10], 1.0);
  EXPECT_DOUBLE_EQ(beyond(signal, 2.0)[5], 3.0);
}

// Outer ring 1 K: 37.66 mm times 13.6 ppm; inner ring 1 K: 27.34 mm times 13.6 ppm, the other way.
TEST(Physics, RingsGrowWithTheirRadii) {
  const Track still{20.0, 20.0}, warm{20.0, 21.0};
  EXPECT_NEAR(ring_growth(still, warm)[1], 0.512176, 1e-6);
  EXPECT_NEAR(ring_growth(warm, still)[1], -0.371824, 1e-6);
}

// A bar without cooling keeps the heat; with it, it cools down.
TEST(Physics, BarOfCellsKeepsItsHeat) {
  Plan plan;
  plan.tracks.fill(Track(4000, 20.0));
  plan[Quantity::speed] = step_at(0, 4000, 1000.0);
  std::fill(plan[Quantity::speed].begin() + 1000, plan[Quantity::speed].end(), 0.0);
  EXPECT_NEAR(bar_of_cells(plan, 2000.0, 1e-3, 0.0)[3999], 1.0, 1e-9);
  EXPECT_LT(bar_of_cells(plan, 2000.0, 1e-3, 1e-2)[3999], 0.8);
}

TEST(Logging, HeldAndRampedDoWhatTheySay) {
  Track line(10000);
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = static_cast<double>(i);
  std::vector<double> time_s;
  time_s.reserve(500);
  for (int i = 0; i < 500; ++i) time_s.push_back(15.0 * i);
  Conventions conventions;
  Chance chance("logging", 1);
  // A speed is whole revolutions, so that a straight line shows its times.
  EXPECT_EQ(logged(line, Quantity::speed, time_s, conventions, chance), time_s);
  conventions.logging = Logging::held;
  const std::vector<double> held = logged(line, Quantity::speed, time_s, conventions, chance);
  double phase_s = std::fmod(held[10], 60.0);
  for (std::size_t i = 10; i < time_s.size(); ++i) {
    EXPECT_LE(held[i], time_s[i]);
    EXPECT_GT(held[i], time_s[i] - 61.0);
    EXPECT_DOUBLE_EQ(std::fmod(held[i], 60.0), phase_s);
  }
  conventions.logging = Logging::ramped;
  const std::vector<double> ramped = logged(line, Quantity::speed, time_s, conventions, chance);
  const std::vector<double> jump = logged(step_at(4001, 10000, 6000.0), Quantity::speed, time_s, conventions, chance);
  std::size_t between = 0;
  for (std::size_t i = 10; i < time_s.size(); ++i) {
    EXPECT_NEAR(ramped[i], time_s[i], 1.0);  // whole seconds
    between += jump[i] > 0.0 && jump[i] < 6000.0;
  }
  EXPECT_GE(between, 3U);
  EXPECT_LE(between, 4U);
  conventions = {};
  conventions.most_late = 1.0;
  const std::vector<double> late = logged(line, Quantity::speed, time_s, conventions, chance);
  for (std::size_t i = 10; i < time_s.size(); ++i) {
    EXPECT_LE(late[i], time_s[i]);
    EXPECT_GE(late[i], time_s[i] - 15.0);
    EXPECT_DOUBLE_EQ(time_s[i] - late[i], time_s[10] - late[10]);
  }
}

TEST(Logging, TemperaturesHaveStepsAndNoise) {
  std::vector<double> time_s(2000);
  for (std::size_t i = 0; i < time_s.size(); ++i) time_s[i] = static_cast<double>(i);
  Conventions conventions;
  conventions.kelvin_step = 0.1;
  conventions.sensor_noise_K = 0.02;
  Chance chance("steps", 1);
  for (const double value : logged(Track(2000, 20.31), Quantity::room, time_s, conventions, chance)) {
    EXPECT_NEAR(10.0 * value, std::round(10.0 * value), 1e-9);
  }
  conventions.kelvin_step = 0.0;
  double squares = 0.0;
  for (const double value : logged(Track(2000, 20.31), Quantity::room, time_s, conventions, chance)) {
    squares += std::pow(value - 20.31, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / 2000.0), 0.02, 0.001);
}

Eigen::MatrixXd covariance(const std::vector<double>& time_s, const Scatter& scatter) {
  const auto n = static_cast<Eigen::Index>(time_s.size());
  Eigen::MatrixXd result(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) {
      const double apart_s = std::abs(time_s[static_cast<std::size_t>(i)] - time_s[static_cast<std::size_t>(k)]);
      result(i, k) = scatter.sigma_um * scatter.sigma_um * std::exp(-apart_s / scatter.time_constant_s);
    }
    result(i, i) += scatter.white_um * scatter.white_um + scatter.resolution_um * scatter.resolution_um / 12.0;
  }
  return result;
}

// d^2 = s' C^-1 s less what the model's columns take, by the whole covariance.
TEST(Noise, DetectabilityIsThatOfTheCovariance) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Chance chance("covariance", seed);
    Recipe recipe;
    recipe.row_s = 60;
    const Scene scene = drawn_scene(recipe, chance);
    const Track track = low_pass(scene.plan[Quantity::load], 900.0);
    const std::optional<double> factor = factor_for(track, scene, 10.0);
    if (!factor) continue;
    const std::vector<double> values = at_rows(scaled(track, *factor), scene.time_s);
    const Eigen::VectorXd s = Eigen::Map<const Eigen::VectorXd>(values.data(), scene.model.rows());
    const Eigen::LLT<Eigen::MatrixXd> c(covariance(scene.time_s, scene.scatter));
    Eigen::MatrixXd model = jacobian(scene.base, scene.plan, scene.time_s);
    model.colwise().normalize();
    const Eigen::MatrixXd weighted = c.solve(model);
    const Eigen::VectorXd along = weighted.transpose() * s;
    const double d2 = s.dot(c.solve(s)) - along.dot((model.transpose() * weighted).ldlt().solve(along));
    EXPECT_NEAR(std::sqrt(d2), 10.0, 0.01) << seed;
  }
}

// Drawn noise comes out of the whitening with variance 1 and without memory.
TEST(Noise, DrawnNoiseIsWhitenedByItsOwnFilter) {
  std::vector<double> time_s(20000);
  for (std::size_t i = 0; i < time_s.size(); ++i) time_s[i] = 15.0 * static_cast<double>(i);
  for (const bool heavy : {false, true}) {
    const Scatter scatter{0.7, 700.0, 0.05, 0.0, heavy};
    Chance chance("noise", 5);
    const std::vector<double> values = drawn(scatter, time_s, chance);
    const Eigen::MatrixXd column = Eigen::Map<const Eigen::VectorXd>(values.data(), 20000);
    const Eigen::VectorXd white = whitened(column, time_s, scatter);
    EXPECT_NEAR(white.squaredNorm() / 20000.0, 1.0, 0.05);
    EXPECT_NEAR(white.head(19999).dot(white.tail(19999)) / 19999.0, 0.0, 0.03);
  }
}

// The catalogue, asked on rows a second apart, means the same by its names, units and signs.
TEST(Hidden, EffectsAreThoseOfTheCatalogue) {
  for (const std::string_view name : kHidden) {
    Chance chance(name, 3);
    const Plan plan = rich_plan(chance);
    const Hidden hidden = drawn_effect(name, plan, 15.0, chance);
    const Effect* effect = find_effect(name, Level::series);
    ASSERT_NE(effect, nullptr);
    ASSERT_EQ(effect->inputs.size(), hidden.inputs.size());
    std::vector<double> parameters;
    for (const Parameter& parameter : effect->parameters) {
      const auto at = std::find_if(hidden.parameters.begin(), hidden.parameters.end(),
                                   [&](const ParameterTruth& truth) { return truth.name == parameter.name; });
      EXPECT_EQ(at == hidden.parameters.end(), parameter.held) << parameter.name;
      parameters.push_back(at == hidden.parameters.end() ? parameter.start : at->value);
    }
    std::vector<double> time_s(hidden.unit.size()), values(hidden.unit.size());
    for (std::size_t i = 0; i < time_s.size(); ++i) time_s[i] = static_cast<double>(i);
    EffectRows rows{time_s, {}};
    for (const Quantity input : hidden.inputs) rows.inputs.emplace_back(plan[input]);
    effect->evaluate(rows, parameters.data(), values.data(), nullptr);
    double worst = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) worst = std::max(worst, std::abs(values[i] - hidden.unit[i]));
    EXPECT_LT(worst, 0.01 * range(hidden.unit)) << name;  // a straight line between seconds in place of a step
  }
}

// Without data every effect has its prior, and so much that a gain of 30 sigma tells a centrifugal shift from a
// heating.
TEST(Rivals, IdealIsThePriorWithoutDataAndSureWithMany) {
  Chance chance("rivals", 1);
  const Scene scene = drawn_scene({}, chance);
  const Rivals bank = rivals(scene);
  const auto is_rival = [](const std::string& effect, const std::vector<Quantity>&) {
    return effect != "centrifugal_shift";
  };
  const Eigen::VectorXd left = surviving(power_of_speed(scene.plan[Quantity::speed], 2.0), scene).normalized();
  const std::set<std::string> effects(bank.effect.begin(), bank.effect.end());
  EXPECT_EQ(effects.size(), kHidden.size() + 1);  // and the heating by speed
  EXPECT_NEAR(ideal(1e-6 * left, bank, is_rival).p, 1.0 / static_cast<double>(effects.size()), 1e-6);
  EXPECT_GT(ideal(30.0 * left, bank, is_rival).p, 0.999);
  EXPECT_NEAR(apart(30.0 * left, bank, [](const auto&, const auto&) { return true; }).d, 0.0, 1e-3);
}

TEST(Cells, AreMadeTheSameWayAgainAndDifferFromEachOther) {
  for (const Cell& cell : cells()) {
    const Made one = cell.make(11), again = cell.make(11);
    ASSERT_FALSE(one.data.columns.empty()) << cell.name;
    EXPECT_EQ(one.what, again.what) << cell.name;
    for (std::size_t k = 0; k < one.data.columns.size(); ++k) {
      EXPECT_EQ(one.data.columns[k].values, again.data.columns[k].values) << cell.name;
    }
    EXPECT_NO_THROW(expect_suits(one.model, one.data)) << cell.name;
    for (const std::string& driver : one.drivers) EXPECT_NE(find_column(one.data, driver), nullptr) << cell.name;
    EXPECT_NE(one.data.columns.front().values, cell.make(12).data.columns.front().values) << cell.name;
  }
}

Made small_set() {
  Recipe recipe;
  recipe.row_s = 15;
  return made(recipe, "twins", 1);
}

TEST(Twins, ColumnsKeepTheirReadings) {
  const Made set = small_set();
  Chance chance("twins", 2);
  const Twin kelvin = twin_of(set, Change::kelvin, chance);
  const Twin renamed = twin_of(set, Change::renamed, chance);
  for (std::size_t k = 0; k < set.data.columns.size(); ++k) {
    const Column &before = set.data.columns[k], &warm = kelvin.made.data.columns[k];
    const bool is_temperature = unit_of(before.name) == "degC";
    EXPECT_EQ(unit_of(warm.name), is_temperature ? "K" : unit_of(before.name));
    EXPECT_DOUBLE_EQ(warm.values[7] - before.values[7], is_temperature ? warm.values[0] - before.values[0] : 0.0)
        << before.name;
    EXPECT_EQ(renamed.made.data.columns[k].values, before.values);
    EXPECT_EQ(renamed.before.at(renamed.made.data.columns[k].name), before.name);
  }
  EXPECT_NO_THROW(expect_suits(kelvin.made.model, kelvin.made.data));
  EXPECT_NO_THROW(expect_suits(renamed.made.model, renamed.made.data));
}

TEST(Twins, RowsAreLeftOutOrAveraged) {
  const Made set = small_set();
  Chance chance("twins", 3);
  const std::size_t rows = set.data.time_s.size();
  const double kept = static_cast<double>(twin_of(set, Change::fewer_rows, chance).made.data.time_s.size());
  EXPECT_NEAR(kept / static_cast<double>(rows), 0.7, 0.05);
  const Series means = twin_of(set, Change::means, chance).made.data;
  EXPECT_EQ(means.time_s.size(), rows / 4);
  EXPECT_DOUBLE_EQ(means.time_s[1] - means.time_s[0], 60.0);
  const std::vector<double>& values = set.data.columns[2].values;
  EXPECT_NEAR(means.columns[2].values[1], (values[4] + values[5] + values[6] + values[7]) / 4.0, 1e-12);
  EXPECT_EQ(twin_of(set, Change::second_target, chance).made.model.targets.size(), 2U);
}

}  // namespace
}  // namespace ballbar::verdicts

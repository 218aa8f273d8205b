#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"

namespace ballbar {
namespace {

// A day in uneven steps: a speed in stages, a temperature that follows, a room that swings.
Series day() {
  Series series;
  series.columns = {
      {"speed_rpm", Role::speed, {}}, {"T_front_degC", Role::bearing, {}}, {"T_room_degC", Role::ambient, {}}};
  double front_degC = 20.0;
  for (int i = 0; i < 2000; ++i) {
    const double time_s = 40.0 * (i + 0.3 * std::sin(i));
    const double speed_rpm = i % 400 < 250 ? 3000.0 * (1 + i / 400) : 0.0;
    front_degC += 0.01 * (20.0 + speed_rpm / 800.0 - front_degC);
    series.time_s.push_back(time_s);
    series.columns[0].values.push_back(speed_rpm);
    series.columns[1].values.push_back(front_degC);
    series.columns[2].values.push_back(20.0 + std::sin(time_s / 9000.0));
  }
  return series;
}

Model with_starts(Model model, const std::vector<std::vector<double>>& starts) {
  for (std::size_t t = 0; t < starts.size(); ++t) {
    for (std::size_t k = 0; k < starts[t].size(); ++k) model.terms[t].settings[k].start = starts[t][k];
  }
  return model;
}

Model many_effects() {
  Model model;
  model.targets = {"z_um"};
  model.constant_um = 0.7;
  model.terms = {term_of("lagged_expansion", {"T_front_degC"}), term_of("speed_heating", {"speed_rpm"}),
                 term_of("play_hysteresis", {"T_room_degC"}), term_of("cooling_asymmetry", {"speed_rpm"}),
                 expression_term("k * lag(lag(T_front_degC - T_room_degC, tau), 60 + speed_rpm / 100)",
                                 {{.name = "k", .unit = "um/K", .start = 1.5, .lower = -10, .upper = 10},
                                  {.name = "tau", .unit = "s", .start = 400, .lower = 1, .upper = 9000}})};
  return with_starts(model, {{2.0, 900.0}, {1.1, 1500.0, 1.4}, {0.9, 0.3}, {0.6, 700.0, 2100.0, 1.2}});
}

std::vector<FittedParameter> at_starts(const Model& model) {
  std::vector<FittedParameter> parameters(1);
  parameters[0].value = model.constant_um.value_or(0.0);
  for (const Term& term : model.terms) {
    for (const Setting& setting : term.settings) {
      parameters.emplace_back();
      parameters.back().value = setting.start;
    }
  }
  return parameters;
}

std::vector<double> inputs_at(const LiveModel& model, const Series& series, std::size_t row) {
  std::vector<double> values;
  for (const std::string& name : model.columns()) values.push_back(find_column(series, name)->values[row]);
  return values;
}

TEST(LiveModel, IsPredictRowByRowToTheLastBit) {
  const Series series = day();
  const Model model = many_effects();
  const Prediction whole = predict(model, at_starts(model), series);
  LiveModel live(model);
  EXPECT_EQ(std::vector<std::string>(live.columns().begin(), live.columns().end()),
            (std::vector<std::string>{"T_front_degC", "speed_rpm", "T_room_degC"}));
  for (std::size_t i = 0; i < series.time_s.size(); ++i) {
    ASSERT_EQ(live.next(series.time_s[i], inputs_at(live, series, i)), whole.predicted_um[i]) << "row " << i;
  }
}

TEST(LiveModel, GoesOnFromItsStateAnywhere) {
  const Series series = day();
  const Model model = many_effects();
  const Prediction whole = predict(model, at_starts(model), series);
  for (const std::size_t until : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{777}}) {
    LiveModel first(model), second(model);
    for (std::size_t i = 0; i < until; ++i) first.next(series.time_s[i], inputs_at(first, series, i));
    second.resume(first.state());
    for (std::size_t i = until; i < until + 50; ++i) {
      ASSERT_EQ(second.next(series.time_s[i], inputs_at(second, series, i)), whole.predicted_um[i])
          << until << ", " << i;
    }
  }
}

std::vector<double> contributions_of(LiveModel& model, const Series& series, std::size_t begin, std::size_t end,
                                     std::size_t terms) {
  std::vector<std::span<const double>> values;
  for (const std::string& name : model.columns())
    values.emplace_back(find_column(series, name)->values.data() + begin, end - begin);
  std::vector<double> contributions_um(terms * (end - begin));
  EXPECT_TRUE(model.next(std::span(series.time_s).subspan(begin, end - begin), values, contributions_um));
  return contributions_um;
}

TEST(LiveModel, ManyRowsAtOnceAreThoseThatComeAlone) {
  const Series series = day();
  const Model model = many_effects();
  const std::size_t terms = model.terms.size();
  LiveModel alone(model), at_once(model);
  for (std::size_t begin = 0, length = 1; begin + length <= 1500; begin += length, length = length * 3 - 1) {
    const std::vector<double> um = contributions_of(at_once, series, begin, begin + length, terms);
    for (std::size_t i = 0; i < length; ++i) {
      alone.next(series.time_s[begin + i], inputs_at(alone, series, begin + i));
      for (std::size_t t = 0; t < terms; ++t) ASSERT_EQ(alone.contributions_um()[t], um[t * length + i]) << begin + i;
    }
    EXPECT_EQ(alone.state().rows, at_once.state().rows);
    EXPECT_EQ(alone.state().time_s, at_once.state().time_s);
    EXPECT_EQ(alone.state().inputs, at_once.state().inputs);
    EXPECT_EQ(alone.state().kept, at_once.state().kept);
  }
}

TEST(LiveModel, ManyRowsOfWhichOneGivesNoNumberChangeNothing) {
  Series series = day();
  series.columns[1].values[30] = std::numeric_limits<double>::quiet_NaN();
  const Model model = many_effects();
  LiveModel live(model);
  contributions_of(live, series, 0, 20, model.terms.size());
  const LiveModel::State before = live.state();
  std::vector<double> contributions_um(20 * model.terms.size());
  std::vector<std::span<const double>> values;
  for (const std::string& name : live.columns()) values.emplace_back(find_column(series, name)->values.data() + 20, 20);
  EXPECT_FALSE(live.next(std::span(series.time_s).subspan(20, 20), values, contributions_um));
  EXPECT_EQ(live.state().rows, before.rows);
  EXPECT_EQ(live.state().time_s, before.time_s);
  EXPECT_EQ(live.state().inputs, before.inputs);
  EXPECT_EQ(live.state().kept, before.kept);
}

// exp of a large number is infinite: the row before it and the row after it meet as if it had not come.
TEST(LiveModel, ForgetsARowThatGivesNoNumber) {
  Model model;
  model.targets = {"z_um"};
  model.terms = {expression_term("lag(exp(T_a_degC), tau)",
                                 {{.name = "tau", .unit = "s", .start = 10, .lower = 1, .upper = 100}})};
  LiveModel with(model), without(model);
  for (const auto& [time_s, value] : {std::pair{0.0, 1.0}, {1.0, 2.0}}) {
    with.next(time_s, {{value}});
    without.next(time_s, {{value}});
  }
  EXPECT_FALSE(std::isfinite(with.next(2.0, {{1000.0}})));
  EXPECT_EQ(with.next(3.0, {{2.5}}), without.next(3.0, {{2.5}}));
}

TEST(LiveModel, SaysWhatCannotRunLive) {
  const auto expect_error = [](const Model& model, const std::string& message) {
    try {
      const LiveModel live(model);
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), message);
    }
  };
  Model clock;
  clock.targets = {"z_um"};
  clock.terms = {term_of("clock_offset", {"T_a_degC"})};
  expect_error(clock,
               "clock_offset(T_a_degC): expected effects that need no later rows, found one that cannot run live.");
  Model trace;
  trace.level = Level::recording;
  expect_error(trace, "expected a model of a drift series, which runs with its signals, found one of recordings.");
}

TEST(LiveModel, RefusesTheStateOfAnotherModel) {
  const Model model = many_effects();
  LiveModel live(model);
  LiveModel::State state = live.state();
  state.kept.pop_back();
  EXPECT_THROW(live.resume(state), Error);
  state = live.state();
  state.rows = 4;
  EXPECT_THROW(live.resume(state), Error);
  state.rows = 2;  // both at 0 s
  EXPECT_THROW(live.resume(state), Error);
  state.time_s[1] = 1.0;
  EXPECT_NO_THROW(live.resume(state));
}

}  // namespace
}  // namespace ballbar

// What the rules of the catalogue say of predictors holds for the effects.
#include <gtest/gtest.h>

#include "made_runs.hpp"
#include "predict/design.hpp"

namespace ballbar {
namespace {

// Every combination of a rule's values at the effect's shapes; the first gain 1, others 0.
std::vector<std::vector<double>> points_of(const Effect& effect) {
  std::vector<std::vector<double>> points{{}};
  std::size_t shape = 0, gains = 0;
  for (const Parameter& parameter : effect.parameters) {
    std::vector<double> values{gains == 0 ? 1.0 : 0.0};
    if (parameter.kind == ParameterKind::gain) {
      ++gains;
    } else {
      values = effect.rules.predictor->grid.at(shape++);
    }
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& point : points) {
      for (const double value : values) {
        longer.push_back(point);
        longer.back().push_back(value);
      }
    }
    points = std::move(longer);
  }
  EXPECT_EQ(shape, effect.rules.predictor->grid.size()) << effect.name;
  return points;
}

std::vector<double> evaluated(const Effect& effect, const Series& run, const std::vector<std::string>& columns,
                              const std::vector<double>& parameters) {
  EffectRows rows{run.time_s, {}};
  for (const std::string& name : columns) rows.inputs.emplace_back(find_column(run, name)->values);
  std::vector<double> values(run.time_s.size());
  effect.evaluate(rows, parameters.data(), values.data(), nullptr);
  return values;
}

// To 1e-12 um of a gain of 1: a difference of two low passes is that of the difference to rounding.
TEST(predictors, an_effect_that_is_a_difference_is_one) {
  const Series run = made::run({}, "difference");
  std::size_t found = 0;
  for (const std::shared_ptr<const Effect>& effect : built_in_catalogue()) {
    if (!effect->rules.predictor || effect->rules.predictor->difference_of.empty()) continue;
    const Effect* other = find_effect(effect->rules.predictor->difference_of, Level::series);
    ASSERT_NE(other, nullptr) << effect->name;
    ASSERT_EQ(effect->inputs.size(), 2U) << effect->name;
    ASSERT_EQ(other->inputs.size(), 1U) << effect->name;
    ++found;
    for (const std::vector<double>& point : points_of(*effect)) {
      const std::vector<double> both = evaluated(*effect, run, {"T_front_degC", "T_base_degC"}, point),
                                plus = evaluated(*other, run, {"T_front_degC"}, point),
                                minus = evaluated(*other, run, {"T_base_degC"}, point);
      for (std::size_t i = 0; i < both.size(); ++i) ASSERT_NEAR(both[i], plus[i] - minus[i], 1e-12) << effect->name;
    }
  }
  EXPECT_GT(found, 0U);
}

TEST(predictors, every_effect_with_a_rule_takes_part_on_what_it_accepts) {
  Series run = made::run({.rows = 300}, "takes part");
  run.columns.push_back({"P_W", Role::load, find_column(run, "speed_rpm")->values});
  const Predictors one = predictors_of({&run, 1}, "z_um", built_in_catalogue());
  std::size_t rules = 0;
  for (const std::shared_ptr<const Effect>& effect : built_in_catalogue()) {
    if (effect->level == Level::series && effect->rules.predictor) ++rules;
  }
  EXPECT_EQ(one.families.size(), rules);
  const std::vector<Series> runs{run, run};
  const Predictors two = predictors_of(runs, "z_um", built_in_catalogue());
  EXPECT_EQ(two.families.size(), rules + 1);
  EXPECT_EQ(two.families.back().kind, PredictorKind::start);
  EXPECT_EQ(two.families.back().members.size(), 2U);  // of each temperature
  for (const Predictor& predictor : two.each) {
    for (const std::string& column : predictor.columns) EXPECT_NE(column, "z_um");
    EXPECT_TRUE(predictor.effect->evaluate.rows) << predictor.effect->name << " cannot run live";
  }
}

}  // namespace
}  // namespace ballbar

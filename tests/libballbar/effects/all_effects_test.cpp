// What holds for every effect of the catalogue.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "ballbar/effects/effect.hpp"
#include "example_rows.hpp"

namespace ballbar {
namespace {

// A parameter vector away from special values: gains 1.3, 1.8 ..., shapes inside their grid.
std::vector<double> generic_parameters(const Effect& effect) {
  std::vector<double> p;
  for (const Parameter& parameter : effect.parameters) {
    if (parameter.kind == ParameterKind::gain) {
      p.push_back(1.3 + 0.5 * static_cast<double>(p.size()));
    } else if (parameter.held) {
      p.push_back(parameter.start);
    } else {
      p.push_back(parameter.start * 1.07 + 1e-3);
    }
  }
  return p;
}

// A check of each effect of the catalogue. Which they were stands in the test's record.
void expect_of_all(const std::function<void(const Effect&)>& check) {
  std::string checked;
  for (const auto& effect : built_in_catalogue()) {
    const std::string label = effect->name + (effect->level == Level::series ? " on a series" : " on a recording");
    SCOPED_TRACE(label);
    check(*effect);
    checked += label + "; ";
  }
  testing::Test::RecordProperty("effects", checked);
}

TEST(all_effects, are_explained) {
  expect_of_all([](const Effect& effect) {
    const Explanation& page = effect.explanation;
    for (const std::string* text : {&page.summary, &page.cause, &page.formula, &page.signature, &page.separated_by,
                                    &page.remedy, &page.validity, &page.source}) {
      EXPECT_GT(text->size(), 5U) << effect.name;
    }
    for (const std::string& other : page.confused_with) {
      EXPECT_NE(other, effect.name);
      EXPECT_NE(find_effect(other, effect.level), nullptr) << effect.name << " is confused with unknown " << other;
    }
    EXPECT_FALSE(page.confused_with.empty()) << effect.name;
    const bool is_error_of_axes = effect.rules.error_fit != ErrorFit::none;
    EXPECT_EQ(page.on_parts.ends_with('.'), is_error_of_axes) << effect.name;
  });
}

// At one corner of its shapes it draws, but for factor and constant, the curve of the effect it says it becomes there.
TEST(all_effects, become_what_they_say) {
  expect_of_all([](const Effect& effect) {
    if (effect.rules.becomes.empty()) return;
    const Effect* plain = find_effect(effect.rules.becomes, effect.level);
    ASSERT_NE(plain, nullptr);
    ASSERT_LE(plain->inputs.size(), effect.inputs.size());
    const auto free = [](const Effect& of) {
      return std::count_if(of.parameters.begin(), of.parameters.end(), [](const Parameter& one) { return !one.held; });
    };
    EXPECT_LT(free(*plain), free(effect));
    std::vector<double> time_s, signal;  // never below its first value
    for (int i = 0; i < 400; ++i) {
      time_s.push_back(60.0 * i);
      signal.push_back(20.0 + 3.0 * (1.0 - std::cos(0.05 * i)) + 0.01 * i);
    }
    const EffectRows rows{time_s, std::vector<std::span<const double>>(effect.inputs.size(), signal)};
    const auto curve = [&](const Effect& of, const std::vector<double>& parameters) {
      std::vector<double> values(time_s.size());
      of.evaluate(rows, parameters.data(), values.data(), nullptr);
      double mean = 0.0, square = 0.0;
      for (const double value : values) mean += value / static_cast<double>(values.size());
      for (double& value : values) square += (value - mean) * (value - mean);
      for (double& value : values) value = (value - mean) / std::sqrt(square);
      return values;
    };
    // Each gain 1, the shapes all at their lowest, all at their highest; the plain one's held ones anywhere on their
    // grid.
    const auto corner = [](const Effect& of, bool high) {
      std::vector<double> point;
      for (const Parameter& parameter : of.parameters) {
        const bool gain = parameter.kind == ParameterKind::gain;
        point.push_back(gain ? 1.0 : high ? parameter.upper : parameter.lower);
      }
      return point;
    };
    double most = 0.0;
    for (const bool high : {false, true}) {
      const std::vector<double> values = curve(effect, corner(effect, high));
      const Parameter& last = plain->parameters.back();
      std::vector<double> lasts{corner(*plain, high).back()};
      if (last.held) lasts.insert(lasts.end(), last.grid.begin(), last.grid.end());
      for (const double value : lasts) {
        std::vector<double> point = corner(*plain, high);
        point.back() = value;
        const std::vector<double> wanted = curve(*plain, point);
        double alike = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i) alike += values[i] * wanted[i];
        if (std::isfinite(alike)) most = std::max(most, std::abs(alike));
      }
    }
    EXPECT_GT(most, 0.9999) << effect.name << " is never " << plain->name;
  });
}

TEST(all_effects, name_parameters_with_their_units) {
  expect_of_all([](const Effect& effect) {
    std::set<std::string> names;
    for (const Parameter& parameter : effect.parameters) {
      EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
      EXPECT_FALSE(parameter.unit.empty());
      EXPECT_FALSE(parameter.meaning.empty());
      EXPECT_LE(parameter.lower, parameter.start) << parameter.name;
      EXPECT_LE(parameter.start, parameter.upper) << parameter.name;
      EXPECT_LT(parameter.lower, parameter.upper) << parameter.name;
      if (parameter.kind == ParameterKind::gain) {
        EXPECT_EQ(parameter.start, 0.0) << parameter.name;
      }
      for (std::size_t i = 0; i < parameter.grid.size(); ++i) {
        EXPECT_GE(parameter.grid[i], parameter.lower);
        EXPECT_LE(parameter.grid[i], parameter.upper);
        if (i > 0) {
          EXPECT_GT(parameter.grid[i], parameter.grid[i - 1]);
        }
      }
    }
  });
}

TEST(all_effects, are_off_at_their_start) {
  expect_of_all([](const Effect& effect) {
    if (effect.rules.is_base) return;  // never off
    const ExampleRows example(effect);
    std::vector<double> p;
    for (const Parameter& parameter : effect.parameters) p.push_back(parameter.start);
    std::vector<double> values(example.size());
    effect.evaluate(example.rows, p.data(), values.data(), nullptr);
    for (const double value : values) EXPECT_EQ(value, 0.0);
  });
}

TEST(all_effects, do_something) {
  expect_of_all([](const Effect& effect) {
    const ExampleRows example(effect);
    const std::vector<double> p = generic_parameters(effect);
    std::vector<double> values(example.size());
    effect.evaluate(example.rows, p.data(), values.data(), nullptr);
    double largest = 0.0;
    for (const double value : values) {
      ASSERT_TRUE(std::isfinite(value));
      largest = std::max(largest, std::abs(value));
    }
    EXPECT_GT(largest, 1e-6);
  });
}

// Of rows 0, i - 1 and i alone, as a live model has them.
TEST(all_effects, are_the_same_row_by_row) {
  expect_of_all([](const Effect& effect) {
    if (effect.level == Level::series) {
      ASSERT_EQ(static_cast<bool>(effect.evaluate.rows), effect.name != "clock_offset") << "all others can run live";
    }
    if (!effect.evaluate.rows) return;
    const ExampleRows example(effect);
    const std::vector<double> p = generic_parameters(effect);
    std::vector<double> whole(example.size()), kept(effect.evaluate.kept);
    effect.evaluate(example.rows, p.data(), whole.data(), nullptr);
    for (std::size_t i = 1; i < example.size(); ++i) {
      const auto three = [&](std::span<const double> values) {
        return i == 1 ? std::vector<double>{values[0], values[1]}
                      : std::vector<double>{values[0], values[i - 1], values[i]};
      };
      const std::vector<double> time_s = three(example.time_s);
      std::vector<std::vector<double>> inputs;
      for (const std::span<const double> input : example.rows.inputs) inputs.push_back(three(input));
      EffectRows rows{time_s, {inputs.begin(), inputs.end()}};
      double value = 0.0;
      if (i == 1) {
        effect.evaluate.rows(rows, 0, 1, p.data(), kept.data(), &value);
        EXPECT_EQ(value, whole[0]);
      }
      effect.evaluate.rows(rows, time_s.size() - 1, time_s.size(), p.data(), kept.data(), &value);
      ASSERT_EQ(value, whole[i]) << "row " << i;
    }
  });
}

TEST(all_effects, have_unit_curves_like_their_derivatives) {
  expect_of_all([](const Effect& effect) {
    if (!effect.evaluate.unit_curves) return;
    const ExampleRows example(effect);
    const std::size_t n = example.size(), k = effect.parameters.size();
    std::vector<std::size_t> gains, shapes;
    for (std::size_t j = 0; j < k; ++j) {
      (effect.parameters[j].kind == ParameterKind::gain ? gains : shapes).push_back(j);
    }
    ASSERT_EQ(shapes.size(), 1U);
    const UnitCurvesAt unit_curves = effect.evaluate.unit_curves(example.rows);
    std::vector<double> p(k, 0.0), values(n), derivatives(n * k), curves(n * gains.size());
    for (const double shape : effect.parameters[shapes.front()].grid) {
      p[shapes.front()] = shape;
      effect.evaluate(example.rows, p.data(), values.data(), derivatives.data());
      unit_curves(shape, curves.data());
      for (std::size_t j = 0; j < gains.size(); ++j) {
        for (std::size_t i = 0; i < n; ++i) {
          ASSERT_NEAR(curves[j * n + i], derivatives[i * k + gains[j]], 1e-13) << shape << ", row " << i;
        }
      }
    }
  });
}

TEST(all_effects, have_derivatives_like_central_differences) {
  expect_of_all([](const Effect& effect) {
    const ExampleRows example(effect);
    const std::vector<double> p = generic_parameters(effect);
    const std::size_t n = example.size(), k = p.size();
    std::vector<double> values(n), again(n), derivatives(n * k);
    effect.evaluate(example.rows, p.data(), values.data(), derivatives.data());
    effect.evaluate(example.rows, p.data(), again.data(), nullptr);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(values[i], again[i], 1e-12 * (1.0 + std::abs(again[i])));
    for (std::size_t j = 0; j < k; ++j) {
      const double step = 1e-5 * std::max(std::abs(p[j]), 1e-2);
      std::vector<double> low(n), high(n), moved = p;
      moved[j] = p[j] - step;
      effect.evaluate(example.rows, moved.data(), low.data(), nullptr);
      moved[j] = p[j] + step;
      effect.evaluate(example.rows, moved.data(), high.data(), nullptr);
      double scale = 0.0, sum = 0.0;
      std::size_t kinks = 0;
      for (std::size_t i = 0; i < n; ++i) scale = std::max(scale, std::abs(derivatives[i * k + j]));
      for (std::size_t i = 0; i < n; ++i) {
        const double difference = (high[i] - low[i]) / (2.0 * step) - derivatives[i * k + j];
        // A threshold, an onset or a reversal may lie within the step of a row.
        if (std::abs(difference) > 1e-5 * (scale + 1e-9) + 1e-7) ++kinks;
        sum += difference;
      }
      EXPECT_LE(kinks, n / 50) << effect.name << " " << effect.parameters[j].name << " differs by " << sum;
    }
  });
}

TEST(catalogue, has_no_name_twice_on_a_level) {
  std::set<std::pair<std::string, Level>> names;
  for (const auto& effect : built_in_catalogue())
    EXPECT_TRUE(names.insert({effect->name, effect->level}).second) << effect->name;
}

}  // namespace
}  // namespace ballbar

#include "made.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "another_run.hpp"
#include "rivals.hpp"

namespace ballbar::verdicts {
namespace {

constexpr int kMostTries = 2000;
constexpr double kLargestCosine = 0.9;

bool is_in_base(const Hidden& hidden, const Base& base) {
  return hidden.effect == base.effect && hidden.inputs == std::vector{base.input};
}

// Of the temperature that the effect reads: threshold and first value as logged, not as they were.
double logged_threshold(const Truth& truth, double threshold, const Track& track, const Series& data) {
  return threshold + track.front() - find_column(data, truth.columns.front())->values.front();
}

Truth truth_of(const Hidden& hidden, const Scene& scene, const Series& data) {
  Truth truth{hidden.effect, {}, hidden.parameters};
  for (const Quantity input : hidden.inputs) truth.columns.push_back(name_of(scene, input));
  for (ParameterTruth& parameter : truth.parameters) {
    if (parameter.name != "threshold_unit") continue;
    parameter.value = logged_threshold(truth, parameter.value, scene.plan[hidden.inputs.front()], data);
  }
  return truth;
}

std::string described(const Truth& truth) {
  std::string text = fmt::format("{}({})", truth.effect, fmt::join(truth.columns, ", "));
  for (const ParameterTruth& parameter : truth.parameters) text += fmt::format(" {:.4g}", parameter.value);
  return text;
}

// `effect` hidden to that d from one scene; false where it does not suit.
bool hide(std::string_view effect, const Scene& scene, double d, std::vector<Hidden>& hidden,
          std::vector<Eigen::VectorXd>& left, Chance& chance) {
  Hidden next = drawn_effect(effect, scene.plan, static_cast<double>(scene.conventions.row_s), chance);
  if (is_in_base(next, scene.base)) return false;
  const std::optional<double> factor = factor_for(next.unit, scene, d, next.at_once_per_K);
  if (!factor) return false;
  const Eigen::VectorXd direction = surviving(next.unit, scene).normalized();
  for (const Eigen::VectorXd& other : left) {
    if (std::abs(other.dot(direction)) > kLargestCosine) return false;
  }
  const double gain = chance.happens(0.5) ? *factor : -*factor;
  next.unit = scaled(std::move(next.unit), gain);
  next.parameters.front().value = gain;
  hidden.push_back(std::move(next));
  left.push_back(direction);
  return true;
}

// Of one hidden effect, the others known.
Ideal ideal_of(const std::vector<Hidden>& hidden, std::size_t which, Scene scene) {
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    if (k == which) continue;
    const std::vector<double> values = at_rows(hidden[k].unit, scene.time_s);
    const Eigen::MatrixXd column = Eigen::Map<const Eigen::VectorXd>(values.data(), scene.model.rows());
    scene.model.conservativeResize(Eigen::NoChange, scene.model.cols() + 1);
    scene.model.rightCols(1) = whitened(column, scene.time_s, scene.scatter);
  }
  const Hidden& one = hidden[which];
  const auto sorted = [](std::vector<Quantity> inputs) {
    std::sort(inputs.begin(), inputs.end());
    return inputs;
  };
  return ideal(surviving(one.unit, scene), rivals(scene),
               [&](const std::string& effect, const std::vector<Quantity>& inputs) {
                 if (effect != one.effect) return true;
                 return effect == "gradient_bending" ? sorted(inputs) != sorted(one.inputs) : inputs != one.inputs;
               });
}

}  // namespace

Made made(const Recipe& recipe, std::string_view stream, std::uint64_t seed) {
  Bench bench = bench_of(recipe, stream, seed);
  for (std::size_t k = 0; k < bench.hidden.size(); ++k) {
    const Ideal one = ideal_of(bench.hidden, k, bench.scene);
    if (one.p > bench.made.ideal_p) continue;
    bench.made.ideal_p = one.p;
    bench.made.rival = one.rival;
  }
  return std::move(bench.made);
}

Bench bench_of(const Recipe& recipe, std::string_view stream, std::uint64_t seed) {
  Chance chance(stream, seed);
  const std::size_t count = recipe.kind == Kind::nothing ? 0 : recipe.count;
  std::vector<std::string_view> effects;  // drawn first and kept: all alike, however seldom one suits
  if (recipe.step) effects.emplace_back("step");
  while (effects.size() < count + (recipe.step ? 1 : 0)) {
    const std::string_view next = kHidden[chance.below(kHidden.size())];
    if (std::find(effects.begin(), effects.end(), next) == effects.end()) effects.push_back(next);
  }
  for (int tries = 0; tries < kMostTries; ++tries) {
    const Scene scene = drawn_scene(recipe, chance);
    std::vector<Hidden> hidden;
    std::vector<Eigen::VectorXd> left;
    for (const std::string_view effect : effects) {
      if (!hide(effect, scene, recipe.d, hidden, left, chance)) break;
    }
    if (hidden.size() < effects.size()) continue;
    Track sum(scene.base.track.size(), 0.0);
    std::vector<Quantity> needed;
    for (const Hidden& one : hidden) {
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one.unit[i];
      needed.insert(needed.end(), one.inputs.begin(), one.inputs.end());
    }
    Made set = assembled(scene, sum, needed, recipe, chance);
    for (const Hidden& one : hidden) {
      set.truths.push_back(truth_of(one, scene, set.data));
      for (const std::string& column : set.truths.back().columns) {
        if (std::find(set.drivers.begin(), set.drivers.end(), column) == set.drivers.end()) {
          set.drivers.push_back(column);
        }
      }
      set.what += (set.what.empty() ? "" : " + ") + described(set.truths.back());
    }
    set.d = recipe.d;
    set.seed = seed;
    return {std::move(set), scene, std::move(hidden)};
  }
  throw std::runtime_error(fmt::format("{} seed {}: expected an effect that can be hidden, found none", stream, seed));
}

}  // namespace ballbar::verdicts

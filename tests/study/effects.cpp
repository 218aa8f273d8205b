// Every effect fitted to its own data with noise: do the 95 % intervals cover, are time constants found?
//
//   study_effects [SEEDS]
//
// Truth: generic parameters away from grid points and bounds; gains so that the effect's rms is 20 times the noise;
// white noise of 1 um. Prints one line a parameter and fails where
//   a single coverage leaves what its number of seeds allows (binomial, p < 1e-4), or the pooled one leaves 92 to 98 %;
//   the median error of a time constant exceeds 10 %.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <vector>

#include "../libballbar/effects/example_rows.hpp"
#include "ballbar/circle/recording.hpp"
#include "ballbar/fit/fit.hpp"

namespace {

using namespace ballbar;

struct Case {
  Model model;
  Series data;                // without the target
  std::vector<double> truth;  // of the effect's parameters
  std::vector<double> signal;
};

std::string column_name(const Effect& effect, const Input& input) {
  if (effect.level == Level::recording) return std::string(trace_column(input.role));
  return input.units.empty() ? input.role : input.role + "_" + input.units.front();
}

Case case_of(const Effect& effect) {
  const ExampleRows example(effect);
  Case made;
  made.model.level = effect.level;
  made.model.targets = {"y_um"};
  made.data.time_s = example.time_s;
  Term term{std::shared_ptr<const Effect>(&effect, [](const Effect*) {}), {}, {}};
  for (std::size_t k = 0; k < effect.inputs.size(); ++k) {
    const std::string name = column_name(effect, effect.inputs[k]);
    made.data.columns.push_back({name, Role::structure, example.columns[k]});
    term.columns.push_back(name);
  }
  for (const Parameter& parameter : effect.parameters) {
    const bool gain = parameter.kind == ParameterKind::gain;
    double value = parameter.start;
    if (gain) value = 1.0 + 0.3 * static_cast<double>(made.truth.size());
    // Off the grid: between two of its points, nearer the start's.
    if (!gain && !parameter.held) {
      const std::size_t middle = parameter.grid.size() / 2;
      value = parameter.grid.size() > 1 ? 0.6 * parameter.grid[middle - 1] + 0.4 * parameter.grid[middle]
                                        : parameter.start * 1.1;
    }
    if (parameter.name == "frequency_Hz") value = 3.3;  // below half the rate of its readings
    // A small offset of a clock shows in the product with its gain alone.
    if (parameter.name == "offset_s") value = 0.8 * parameter.grid.back();
    if (parameter.name == "onset_s") value = 0.4 * (example.time_s.front() + example.time_s.back());
    made.truth.push_back(value);
    term.settings.push_back({parameter.held, parameter.start, parameter.lower, parameter.upper, false});
  }
  made.model.terms.push_back(term);
  const auto evaluated = [&] {
    std::vector<double> values(example.size());
    effect.evaluate(example.rows, made.truth.data(), values.data(), nullptr);
    return values;
  };
  made.signal = evaluated();
  double mean = 0.0, square = 0.0;
  for (const double value : made.signal) mean += value / static_cast<double>(made.signal.size());
  for (const double value : made.signal) square += (value - mean) * (value - mean);
  const double factor = 20.0 / std::sqrt(square / static_cast<double>(made.signal.size()));
  for (std::size_t k = 0; k < made.truth.size(); ++k) {
    if (effect.parameters[k].kind == ParameterKind::gain && effect.name != "circle") made.truth[k] *= factor;
  }
  made.signal = evaluated();
  return made;
}

struct Tally {
  std::size_t covered = 0, counted = 0;
  std::vector<double> relative_error;
};

double binomial_probability_outside(std::size_t covered, std::size_t counted) {
  // Two-sided, normal with the continuity correction: good enough for a limit of 1e-4.
  const auto n = static_cast<double>(counted);
  const double away = std::max(0.0, std::abs(static_cast<double>(covered) - 0.95 * n) - 0.5);
  return std::erfc(away / std::sqrt(2.0 * n * 0.95 * 0.05));
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 25;
  bool failed = false;
  std::size_t all_covered = 0, all_counted = 0;
  fmt::print("{:<22} {:<26} {:>9} {:>10} {:>9}\n", "effect", "parameter", "covered %", "median err", "counted");
  for (const auto& effect : built_in_catalogue()) {
    const Case made = case_of(*effect);
    std::map<std::size_t, Tally> tallies;
    for (int seed = 0; seed < seeds; ++seed) {
      std::seed_seq key{seed, static_cast<int>(std::hash<std::string>{}(effect->name) & 0xffffU)};
      std::mt19937_64 random(key);
      std::normal_distribution<double> noise;
      Series data = made.data;
      Column target{"y_um", Role::measured, made.signal};
      for (double& value : target.values) value += noise(random);
      data.columns.push_back(std::move(target));
      const Fit found = fit(made.model, data);
      for (std::size_t k = 0; k < made.truth.size(); ++k) {
        const FittedParameter& parameter = found.parameters[k + 1];
        if (parameter.state == ParameterState::held) continue;
        Tally& tally = tallies[k];
        ++tally.counted;
        if (std::abs(parameter.value - made.truth[k]) <= 1.96 * parameter.sigma) ++tally.covered;
        tally.relative_error.push_back(std::abs(parameter.value / made.truth[k] - 1.0));
      }
    }
    for (auto& [k, tally] : tallies) {
      std::nth_element(tally.relative_error.begin(),
                       tally.relative_error.begin() + static_cast<std::ptrdiff_t>(tally.relative_error.size() / 2),
                       tally.relative_error.end());
      const double median = tally.relative_error[tally.relative_error.size() / 2];
      // The sigma of an onset is a bound, a row's width: it may cover more.
      const bool too_wide = effect->parameters[k].name == "onset_s" && 20 * tally.covered > 19 * tally.counted;
      const bool off = !too_wide && binomial_probability_outside(tally.covered, tally.counted) < 1e-4;
      const bool slow = effect->parameters[k].name.ends_with("time_constant_s") && median > 0.10;
      failed = failed || off || slow;
      all_covered += tally.covered;
      all_counted += tally.counted;
      fmt::print("{:<22} {:<26} {:>9.1f} {:>10.4f} {:>9}{}\n", effect->name, effect->parameters[k].name,
                 100.0 * static_cast<double>(tally.covered) / static_cast<double>(tally.counted), median, tally.counted,
                 off || slow ? "  <- outside" : "");
    }
  }
  const double pooled = 100.0 * static_cast<double>(all_covered) / static_cast<double>(all_counted);
  fmt::print("pooled over all parameters: {:.2f} % of {}\n", pooled, all_counted);
  return failed || pooled < 92.0 || pooled > 98.0 ? 1 : 0;
}

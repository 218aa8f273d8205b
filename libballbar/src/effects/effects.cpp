#include <algorithm>

#include "ballbar/effects/effect.hpp"
#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/interruption.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

std::vector<double> grid_of(const Parameter& parameter, const EffectRows& rows, double lower, double upper,
                            std::size_t most) {
  std::vector<double> grid = parameter.grid_on ? parameter.grid_on(rows, lower, upper, most) : parameter.grid;
  std::erase_if(grid, [&](double value) { return value < lower || value > upper; });
  return grid;
}

void Evaluate::operator()(const EffectRows& of, const double* at, double* values, double* derivatives) const {
  expect_no_interruption();
  if (std::is_sorted(of.time_s.begin(), of.time_s.end())) {
    all(of, at, values, derivatives);
    return;
  }
  if (derivatives != nullptr && parameters == 0) {
    throw Error("expected an effect that states how many parameters it has (Evaluate::parameters), found none.");
  }
  EffectRows own = of;
  for (const std::span<const double> input : of.inputs) own.zero.push_back(input.front());
  for (const RowRange& range : runs_of(of.time_s)) {
    const std::size_t n = range.end - range.begin;
    own.time_s = of.time_s.subspan(range.begin, n);
    for (std::size_t k = 0; k < own.inputs.size(); ++k) own.inputs[k] = of.inputs[k].subspan(range.begin, n);
    all(own, at, values + range.begin, derivatives == nullptr ? nullptr : derivatives + range.begin * parameters);
    ++own.run;
  }
}

bool applies_to(const Effect& effect, Motion motion) {
  return effect.motions.empty() ||
         std::find(effect.motions.begin(), effect.motions.end(), motion) != effect.motions.end();
}

bool needs_clock(const Effect& effect) {
  constexpr std::string_view kOfTime[] = {"s", "min", "h", "1/s", "um/s", "um/min", "um/h"};
  return effect.time_only || std::any_of(effect.parameters.begin(), effect.parameters.end(), [&](const Parameter& one) {
           return std::find(std::begin(kOfTime), std::end(kOfTime), one.unit) != std::end(kOfTime);
         });
}

const Effect* find_effect(std::string_view name, Level level, const Catalogue& catalogue) {
  const auto effect = std::find_if(catalogue.begin(), catalogue.end(),
                                   [&](const auto& one) { return one->name == name && one->level == level; });
  return effect == catalogue.end() ? nullptr : effect->get();
}

const Effect* base_effect(Level level, const Catalogue& catalogue) {
  const auto effect = std::find_if(catalogue.begin(), catalogue.end(),
                                   [&](const auto& one) { return one->rules.is_base && one->level == level; });
  return effect == catalogue.end() ? nullptr : effect->get();
}

}  // namespace ballbar

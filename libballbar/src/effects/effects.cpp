#include <algorithm>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

std::vector<double> grid_of(const Parameter& parameter, const EffectRows& rows, double lower, double upper,
                            std::size_t most) {
  std::vector<double> grid = parameter.grid_on ? parameter.grid_on(rows, lower, upper, most) : parameter.grid;
  std::erase_if(grid, [&](double value) { return value < lower || value > upper; });
  return grid;
}

bool applies_to(const Effect& effect, Motion motion) {
  return effect.motions.empty() ||
         std::find(effect.motions.begin(), effect.motions.end(), motion) != effect.motions.end();
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

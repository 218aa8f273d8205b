// An effect test of a model and data that nothing else is asked of.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "ballbar/workbench/workbench.hpp"

namespace ballbar {

inline EffectTest effect_test(Model model, const std::vector<Term>& added, Series data) {
  return Workbench(std::make_shared<const Series>(std::move(data)), std::move(model)).effect_test(added);
}

}  // namespace ballbar

#include "cells.hpp"

#include <fmt/format.h>

#include <utility>

namespace ballbar::verdicts {
namespace {

struct Condition {
  const char* name;
  Logging logging = Logging::exact;
  double most_late = 0.0;
  double kelvin_step = 0.01;
};
constexpr Condition kConditions[] = {{"exact"},
                                     {"held", Logging::held},
                                     {"ramped", Logging::ramped},
                                     {"late", Logging::exact, 1.0},
                                     {"0.1K", Logging::exact, 0.0, 0.1}};

Cell cell(std::string name, std::string aim, const Recipe& recipe) {
  const auto make = [=](std::uint64_t seed) { return made(recipe, name, seed); };
  return {name, std::move(aim), make};
}

Recipe under(const Condition& condition, Recipe recipe) {
  recipe.logging = condition.logging;
  recipe.most_late = condition.most_late;
  recipe.kelvin_step = condition.kelvin_step;
  return recipe;
}

}  // namespace

std::vector<Cell> cells() {
  std::vector<Cell> result;
  const auto nothing = [](Noise noise, std::size_t fakes = 0) {
    Recipe recipe;
    recipe.kind = Kind::nothing;
    recipe.noise = noise;
    recipe.fakes = fakes;
    return recipe;
  };
  const std::string most = "nothing >= 95, wrong <= 2";
  result.push_back(cell("nothing-ar0.9", most, nothing(Noise::ar90)));
  result.push_back(cell("nothing-ar0.98", most, nothing(Noise::ar98)));
  result.push_back(cell("nothing-rounded", most, nothing(Noise::coarse)));
  result.push_back(cell("nothing-heavy", most, nothing(Noise::heavy)));
  result.push_back(cell("nothing-20fakes", most, nothing(Noise::any, 20)));
  for (const Condition& condition : kConditions) {
    if (&condition == kConditions) continue;  // exact: above
    result.push_back(cell(fmt::format("nothing-{}", condition.name), "nothing >= 90, wrong <= 2",
                          under(condition, nothing(Noise::any))));
  }
  for (const double d : {10.0, 15.0}) {
    for (const Condition& condition : kConditions) {
      Recipe recipe;
      recipe.d = d;
      result.push_back(cell(fmt::format("one-{:.0f}-{}", d, condition.name),
                            fmt::format("right >= {}, wrong <= 1, driver >= 85", d < 12.0 ? 68 : 80),
                            under(condition, recipe)));
    }
  }
  Recipe faint;
  faint.d = 7.5;
  result.push_back(cell("one-7.5-exact", "right >= 52, wrong <= 2", faint));
  Recipe poor;
  poor.is_poor = true;
  result.push_back(cell("poor-10", "right >= 40, driver >= 65, wrong <= 2", poor));
  Recipe two;
  two.count = 2;
  two.d = 12.0;
  result.push_back(cell("two-12", "right >= 45, any >= 85, driver >= 60, wrong <= 2", two));
  return result;
}

}  // namespace ballbar::verdicts

#include "cells.hpp"

#include <fmt/format.h>

#include <utility>

#include "outside.hpp"
#include "own.hpp"

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

Cell cell(const std::string& name, std::string aim, const Recipe& recipe) {
  const auto make = [=](std::uint64_t seed) { return made(recipe, name, seed); };
  return {name, std::move(aim), make, std::nullopt};
}

Recipe under(const Condition& condition, Recipe recipe) {
  recipe.logging = condition.logging;
  recipe.most_late = condition.most_late;
  recipe.kelvin_step = condition.kelvin_step;
  return recipe;
}

void add_outside(std::vector<Cell>& cells) {
  constexpr std::pair<const char*, Outside> kOutside[] = {{"outside-driven", Outside::driven},
                                                          {"outside-time", Outside::of_time},
                                                          {"outside-left-out", Outside::left_out},
                                                          {"outside-bar", Outside::bar},
                                                          {"outside-not-logged", Outside::not_logged}};
  for (const auto& [name, kind] : kOutside) {
    const auto make = [name = std::string(name), kind = kind](std::uint64_t seed) {
      return made_outside(kind, name, seed);
    };
    cells.push_back({name, "right >= 75, wrong <= 5", make, std::nullopt});
  }
}

void add_own(std::vector<Cell>& cells) {
  constexpr std::pair<const char*, Own> kOwn[] = {{"own-exponent", Own::exponent}, {"own-tau", Own::time_constant}};
  for (const auto& [name, own] : kOwn) {
    const auto make = [name = std::string(name), own = own](std::uint64_t seed) { return made_own(own, name, seed); };
    cells.push_back({name, "right >= 90, wrong <= 2", make, std::nullopt});
  }
}

// One of three sets has nothing hidden.
void add_twins(std::vector<Cell>& cells) {
  constexpr std::pair<const char*, Change> kChanges[] = {{"twin-fewer-rows", Change::fewer_rows},
                                                         {"twin-renamed", Change::renamed},
                                                         {"twin-kelvin", Change::kelvin},
                                                         {"twin-60s-means", Change::means},
                                                         {"twin-noise-column", Change::noise_column},
                                                         {"twin-second-target", Change::second_target}};
  for (const auto& [name, change] : kChanges) {
    const auto make = [name = std::string(name)](std::uint64_t seed) {
      Recipe recipe;
      recipe.kind = seed % 3 == 0 ? Kind::nothing : Kind::effects;
      recipe.row_s = 15;
      return made(recipe, name, seed);
    };
    cells.push_back({name, "same >= 95", make, change});
  }
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
  poor.course = Course::poor;
  result.push_back(cell("poor-10", "right >= 40, driver >= 65, wrong <= 2", poor));
  Recipe two;
  two.count = 2;
  two.d = 12.0;
  result.push_back(cell("two-12", "right >= 45, any >= 85, driver >= 60, wrong <= 2", two));
  Recipe step;
  step.d = 20.0;
  step.count = 0;
  step.step = true;
  result.push_back(cell("step-20", "right >= 95, wrong <= 2", step));
  step.count = 1;
  result.push_back(cell("step-one-20", "any >= 95, wrong <= 2", step));
  two.d = 15.0;
  result.push_back(cell("two-15", "right >= 50, wrong <= 4", two));
  two.d = 20.0;
  result.push_back(cell("two-20", "right >= 60, wrong <= 4", two));
  poor.d = 15.0;
  result.push_back(cell("poor-15", "right >= 50, in set >= 85, wrong <= 4", poor));
  add_outside(result);
  add_own(result);
  add_twins(result);
  return result;
}

Twin twin_of(const Made& made, const Cell& cell) {
  Chance chance(cell.name + " changed", made.seed);
  return twin_of(made, *cell.change, chance);
}

}  // namespace ballbar::verdicts

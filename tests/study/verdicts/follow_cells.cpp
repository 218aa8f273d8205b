#include "follow_cells.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace ballbar::verdicts {
namespace {

// The column that drives what is hidden, logged a second time.
Made with_a_sensor_twice(Made made) {
  for (const std::string& name : made.drivers) {
    if (unit_of(name) != "degC") continue;
    Column again = *find_column(made.data, name);
    again.name = "T_again_degC";
    made.data.columns.push_back(std::move(again));
    return made;
  }
  throw std::runtime_error("no temperature drives what is hidden");
}

}  // namespace

std::vector<FollowCell> follow_cells(double hours) {
  std::vector<FollowCell> result;
  const auto add = [&](const std::string& name, Recipe recipe, bool is_nothing) {
    recipe.kind = is_nothing ? Kind::nothing : Kind::effects;
    recipe.hours = hours;
    result.push_back({name, is_nothing, [=](std::uint64_t seed) { return made(recipe, "follow " + name, seed); }});
  };
  Recipe recipe;
  const auto with_noise = [](Noise noise, std::size_t fakes = 0) {
    Recipe of;
    of.noise = noise;
    of.fakes = fakes;
    return of;
  };
  const auto logged = [](Logging logging, double most_late, double kelvin_step) {
    Recipe of;
    of.logging = logging;
    of.most_late = most_late;
    of.kelvin_step = kelvin_step;
    return of;
  };
  add("nothing-ar0.9", with_noise(Noise::ar90), true);
  add("nothing-ar0.98", with_noise(Noise::ar98), true);
  add("nothing-rounded", with_noise(Noise::coarse), true);
  add("nothing-heavy", with_noise(Noise::heavy), true);
  add("nothing-20fakes", with_noise(Noise::any, 20), true);
  add("nothing-held", logged(Logging::held, 0.0, 0.01), true);
  add("nothing-ramped", logged(Logging::ramped, 0.0, 0.01), true);
  add("nothing-late", logged(Logging::exact, 1.0, 0.01), true);
  add("nothing-0.1K", logged(Logging::exact, 0.0, 0.1), true);
  add("one-10-exact", recipe, false);
  add("one-10-held", logged(Logging::held, 0.0, 0.01), false);
  recipe.hours = hours;
  result.push_back({"sensor-twice-10", false, [recipe](std::uint64_t seed) {
                      for (std::uint64_t further = 0;; further += 100000) {
                        const Made one = made(recipe, "follow sensor-twice", seed + further);
                        const bool suits = std::any_of(one.drivers.begin(), one.drivers.end(),
                                                       [](const auto& name) { return unit_of(name) == "degC"; });
                        if (suits) return with_a_sensor_twice(one);
                      }
                    }});
  return result;
}

}  // namespace ballbar::verdicts

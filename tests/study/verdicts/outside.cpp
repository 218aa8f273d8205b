#include "outside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "physics.hpp"
#include "rivals.hpp"
#include "scene.hpp"

namespace ballbar::verdicts {
namespace {

constexpr double kLeastApart = 6.0;
constexpr int kMostTries = 400;    // scenes
constexpr int kDrawsOnScene = 10;  // one after the other, the first that suits

struct Outsider {
  std::string what;
  std::vector<Quantity> inputs;
  Track unit;
  std::string effect = {};  // in the catalogue, and left out
  double at_once_per_K = 0.0;
};

template <class Form>
Track formed(const Track& track, Form form) {
  Track result = track;
  for (double& value : result) value = form(value);
  return result;
}

Track product(Track one, const Track& other) {
  for (std::size_t i = 0; i < one.size(); ++i) one[i] *= other[i];
  return one;
}

// As it was so many seconds before.
Track delayed(const Track& track, std::size_t by_s) {
  Track result(track.size(), track.front());
  std::copy(track.begin(), track.end() - static_cast<std::ptrdiff_t>(by_s),
            result.begin() + static_cast<std::ptrdiff_t>(by_s));
  return result;
}

struct Driver {
  Quantity quantity = Quantity::speed;
  Track push;  // since the first second
};

Driver drawn_driver(const Plan& plan, Chance& chance) {
  const auto quantity = static_cast<Quantity>(chance.below(kQuantities));
  return {quantity, quantity == Quantity::speed ? power_of_speed(plan[quantity], 5.0 / 3.0) : rise(plan[quantity])};
}

Outsider driven(const Plan& plan, Chance& chance) {
  const double tau_s = chance.log_between(200.0, 6000.0);
  const Driver driver = drawn_driver(plan, chance);
  const std::vector<Quantity> inputs{driver.quantity};
  const Track slow = low_pass(driver.push, tau_s);
  const double size = range(slow);
  switch (chance.below(7)) {
    case 0: {
      const double knee = chance.between(0.15, 0.4) * size;
      return {"saturates", inputs, formed(slow, [&](double x) { return std::tanh(x / knee); })};
    }
    case 1:
      return {"square root", inputs, formed(slow, [](double x) { return std::copysign(std::sqrt(std::abs(x)), x); })};
    case 2:
      return {"speed times load",
              {Quantity::speed, Quantity::load},
              low_pass(product(plan[Quantity::speed], plan[Quantity::load]), tau_s)};
    case 3: {
      const double by_s = chance.log_between(300.0, 2400.0);
      return {fmt::format("dead time {:.0f} s", by_s), inputs,
              delayed(low_pass(driver.push, 0.3 * tau_s), static_cast<std::size_t>(by_s))};
    }
    case 4:
      return {"two poles", inputs, low_pass(slow, tau_s * chance.between(0.3, 1.0))};
    case 5: {
      Track grown = slow;
      const double more = chance.between(1.5, 4.0);
      for (std::size_t i = 0; i < grown.size(); ++i) {
        grown[i] *= 1.0 + more * static_cast<double>(i) / static_cast<double>(grown.size());
      }
      return {"gain grows", inputs, std::move(grown)};
    }
    default: {
      const Track change = difference(driver.push, low_pass(driver.push, chance.log_between(100.0, 800.0)));
      return {"rate, either way", inputs, low_pass(formed(change, [](double x) { return std::abs(x); }), 0.5 * tau_s)};
    }
  }
}

// Smooth and random: white pushes through four bodies.
Track smooth_curve(std::size_t length, double length_s, Chance& chance) {
  const double tau_s = 0.5 * length_s;
  const auto before = static_cast<std::size_t>(10.0 * tau_s);
  Track track(before + length);
  for (double& value : track) value = chance.normal();
  for (int body = 0; body < 4; ++body) track = low_pass(track, tau_s);
  return {track.begin() + static_cast<std::ptrdiff_t>(before), track.end()};
}

Outsider of_time(const Plan& plan, Chance& chance) {
  const std::size_t length = plan[Quantity::speed].size();
  const auto span_s = static_cast<double>(plan.span_s);
  Outsider result;
  switch (chance.below(3)) {
    case 0: {
      const double length_s = span_s / chance.between(3.0, 8.0);
      result = {fmt::format("curve of {:.0f} s", length_s), {}, smooth_curve(length, length_s, chance)};
      break;
    }
    case 1: {
      const double period_s = span_s / chance.between(3.0, 10.0), phase = chance.uniform();
      result = {fmt::format("sawtooth of {:.0f} s", period_s), {}, Track(length)};
      for (std::size_t i = 0; i < length; ++i) {
        const double turns = static_cast<double>(i) / period_s + phase;
        result.unit[i] = turns - std::floor(turns);
      }
      break;
    }
    default: {
      const double width_s = span_s / chance.between(12.0, 40.0), middle_s = span_s * chance.between(0.15, 0.85);
      result = {fmt::format("burst of {:.0f} s", width_s), {}, Track(length)};
      for (std::size_t i = 0; i < length; ++i) {
        const double x = (static_cast<double>(i) - middle_s) / width_s;
        result.unit[i] = std::exp(-0.5 * x * x) * std::cos(0.5 * std::numbers::pi * x);
      }
      break;
    }
  }
  return result;
}

Outsider left_out(const Plan& plan, double row_s, Chance& chance) {
  constexpr std::array kLeftOut{"lagged_expansion", "centrifugal_shift", "cooling_asymmetry", "viscosity_feedback",
                                "load_heating",     "preload_loss",      "play_hysteresis"};
  Hidden hidden = drawn_effect(kLeftOut[chance.below(kLeftOut.size())], plan, row_s, chance);
  return {hidden.effect + " left out", hidden.inputs, std::move(hidden.unit), hidden.effect, hidden.at_once_per_K};
}

Outsider not_logged(const Plan& plan, double row_s, Chance& chance) {
  constexpr std::array kOfTemperatures{"expansion", "lagged_expansion", "preload_loss", "play_hysteresis"};
  Hidden hidden = drawn_effect(kOfTemperatures[chance.below(kOfTemperatures.size())], plan, row_s, chance);
  return {hidden.effect + " not logged", hidden.inputs, std::move(hidden.unit)};
}

Outsider drawn_outsider(Outside kind, const Plan& plan, double row_s, Chance& chance) {
  switch (kind) {
    case Outside::driven:
      return driven(plan, chance);
    case Outside::of_time:
      return of_time(plan, chance);
    case Outside::left_out:
      return left_out(plan, row_s, chance);
    case Outside::bar:
      return {"bar of cells",
              {Quantity::speed, Quantity::coolant},
              bar_of_cells(plan, chance.log_between(1500.0, 12000.0), chance.log_between(2e-5, 2e-4),
                           chance.log_between(1e-3, 1e-2))};
    case Outside::not_logged:
      break;
  }
  return not_logged(plan, row_s, chance);
}

// What drives a quantity of a plan: where its own column is missing these say rightly what is at work.
std::vector<Quantity> causes_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::bearing:
      return {Quantity::speed, Quantity::load, Quantity::housing, Quantity::coolant, Quantity::room};
    case Quantity::housing:
      return {Quantity::speed, Quantity::load, Quantity::bearing, Quantity::coolant, Quantity::room};
    case Quantity::coolant:
      return {Quantity::speed, Quantity::load, Quantity::room};
    default:
      return {};
  }
}

}  // namespace

Track bar_of_cells(const Plan& plan, double diffusion_s, double heat_per_s, double cooling_per_s) {
  constexpr std::size_t kCells = 20;
  // diffusion_s: length^2 / diffusivity; from cell to cell 1 / s
  const double passes = static_cast<double>(kCells * kCells) / diffusion_s;
  const Track friction = power_of_speed(plan[Quantity::speed], 5.0 / 3.0);
  const Track& coolant = plan[Quantity::coolant];
  std::array<double, kCells> cell{};
  Track mean;
  mean.reserve(friction.size());
  for (std::size_t i = 0; i < friction.size(); ++i) {
    double sum = 0.0;
    for (const double value : cell) sum += value;
    mean.push_back(sum / static_cast<double>(kCells));
    std::array<double, kCells> next = cell;
    for (std::size_t k = 0; k + 1 < kCells; ++k) {
      const double flow = passes * (cell[k] - cell[k + 1]);
      next[k] -= flow;
      next[k + 1] += flow;
    }
    next.front() += heat_per_s * static_cast<double>(kCells) * friction[i];
    next.back() += cooling_per_s * (coolant[i] - coolant[0] - cell.back());
    cell = next;
  }
  return mean;
}

Made made_outside(Outside kind, std::string_view stream, std::uint64_t seed) {
  Chance chance(stream, seed);
  const Recipe recipe;
  for (int tries = 0; tries < kMostTries; ++tries) {
    const Scene scene = drawn_scene(recipe, chance);
    std::optional<Rivals> bank;
    for (int draws = 0; draws < kDrawsOnScene; ++draws) {
      const double d = chance.between(15.0, 40.0);
      const Outsider outsider = drawn_outsider(kind, scene.plan, static_cast<double>(scene.conventions.row_s), chance);
      std::optional<Quantity> gone;
      if (kind == Outside::not_logged) gone = outsider.inputs.front();
      if (gone && !scene.base.effect.empty() && *gone == scene.base.input) continue;
      if (!outsider.effect.empty() && outsider.effect == scene.base.effect) continue;
      const std::optional<double> factor = factor_for(outsider.unit, scene, d, outsider.at_once_per_K);
      if (!factor) continue;
      if (!bank) bank = rivals(scene);
      const auto is_rival = [&](const std::string& effect, const std::vector<Quantity>& inputs) {
        return effect != outsider.effect && (!gone || std::find(inputs.begin(), inputs.end(), *gone) == inputs.end());
      };
      const Apart nearest = apart(*factor * surviving(outsider.unit, scene), *bank, is_rival);
      if (nearest.d < kLeastApart) continue;
      const Track signal = scaled(outsider.unit, chance.happens(0.5) ? *factor : -*factor);
      Made set = assembled(scene, signal, gone ? std::vector<Quantity>{} : outsider.inputs, recipe, chance, gone);
      set.is_outside = true;
      set.what = outsider.what;
      for (const Quantity input : gone ? causes_of(*gone) : outsider.inputs) {
        const std::string name = name_of(scene, input);
        if (find_column(set.data, name) != nullptr) set.drivers.push_back(name);
      }
      for (const Quantity input : outsider.inputs) {
        set.what += " " + name_of(scene, input);
      }
      if (!outsider.effect.empty()) set.without = {outsider.effect};
      set.what += fmt::format(", d {:.0f}, {:.0f} from {}", d, nearest.d, nearest.effect);
      set.d = d;
      set.seed = seed;
      return set;
    }
  }
  throw std::runtime_error(fmt::format("{} seed {}: expected what no effect makes, found none", stream, seed));
}

}  // namespace ballbar::verdicts

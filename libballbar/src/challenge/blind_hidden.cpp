#include <fmt/format.h>

#include <array>

#include "challenge/blind_parts.hpp"
#include "diagnosis/signatures/bank.hpp"
#include "model/bindings.hpp"

namespace ballbar::blind {
namespace {

constexpr std::array kDriven{"expansion",          "lagged_expansion", "centrifugal_shift", "cooling_asymmetry",
                             "viscosity_feedback", "load_heating",     "gradient_bending",  "bearing_rings",
                             "preload_loss",       "play_hysteresis"};

const std::vector<double>& values_of(const Series& series, std::string_view column) {
  return find_column(series, column)->values;
}

// A drive of 0 and 1 that nobody logs, at times of its own, seen through a body that follows it slowly.
std::vector<double> unlogged_machine(const std::vector<double>& time_s, Random& random) {
  const double follows_s = log_between(random, 300.0, 5400.0);
  const double stays_s = (time_s.back() - time_s.front()) / between(random, 4.0, 10.0);
  std::vector<double> signal;
  double on = 0.0, state = 0.0, last_s = time_s.front(), next_s = time_s.front() + stays_s * between(random, 0.3, 1.7);
  for (const double now_s : time_s) {
    state = on + (state - on) * std::exp(-(now_s - last_s) / follows_s);
    if (now_s >= next_s) {
      on = 1.0 - on;
      next_s = now_s + stays_s * between(random, 0.3, 1.7);
    }
    last_s = now_s;
    signal.push_back(state);
  }
  return signal;
}

std::vector<double> squared_rate(const Series& sensors, std::string_view column) {
  const std::vector<double>& values = values_of(sensors, column);
  std::vector<double> signal(values.size(), 0.0);
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double K_per_min = (values[i] - values[i - 1]) / (sensors.time_s[i] - sensors.time_s[i - 1]) * 60.0;
    signal[i] = K_per_min * K_per_min;
  }
  return signal;
}

std::vector<BoundEffect> expansions_of(std::initializer_list<const char*> columns) {
  std::vector<BoundEffect> bounds;
  for (const char* column : columns) {
    bounds.push_back({find_effect("expansion", Level::series), {column}});
    bounds.push_back({find_effect("lagged_expansion", Level::series), {column}});
  }
  return bounds;
}

BoundEffect on_any(std::string_view effect) { return {find_effect(effect, Level::series), {}}; }

// The table of blind.hpp.
std::vector<BoundEffect> match_of(std::string_view cause) {
  std::vector<BoundEffect> match;
  if (cause == "z_centrifugal_um") return {on_any("centrifugal_shift")};
  if (cause == "z_rings_um") {
    match = expansions_of({"T_front_degC", "T_rear_degC"});
    for (const char* effect : {"bearing_rings", "cooling_asymmetry", "viscosity_feedback"}) {
      match.push_back(on_any(effect));
    }
  } else if (cause == "z_housing_um") {
    match = expansions_of({"T_front_degC", "T_rear_degC", "T_motor_degC", "T_housing_degC", "T_coolant_degC"});
  } else if (cause == "z_structure_um" || cause == "y_structure_um") {
    constexpr std::array kStructure{"T_head_degC", "T_column_degC", "T_room_degC"};
    match = expansions_of({kStructure[0], kStructure[1], kStructure[2]});
    for (const char* hot : kStructure) {
      for (const char* cold : kStructure) {
        if (hot != cold) match.push_back({find_effect("gradient_bending", Level::series), {hot, cold}});
      }
    }
  } else {
    match = expansions_of(
        {"T_front_degC", "T_rear_degC", "T_motor_degC", "T_housing_degC", "T_coolant_degC", "T_head_degC"});
    match.push_back(on_any("gradient_bending"));
  }
  return match;
}

}  // namespace

Injection drawn_injection(const BoundEffect& bound, const Series& logged, Random& random) {
  Injection injection = injection_of(bound, logged);
  for (std::size_t k = 0; k < injection.parameters.size(); ++k) {
    const Parameter& parameter = bound.effect->parameters[k];
    double& value = injection.parameters[k];
    if (parameter.kind == ParameterKind::gain) {
      value = chance(random, 0.5) ? 1.0 : -1.0;
    } else if (parameter.name == "threshold_unit" || parameter.name == "half_width_unit") {
      const std::vector<double>& moves = values_of(logged, bound.columns.front());
      const double rise = *std::max_element(moves.begin(), moves.end()) - moves.front();
      value = parameter.name == "threshold_unit" ? between(random, 0.2, 0.7) * rise
                                                 : between(random, 0.05, 0.2) * range_of(moves);
    } else if (!parameter.held && parameter.grid.size() > 2) {
      const double low = std::max(parameter.grid[1], 1e-9), high = parameter.grid[parameter.grid.size() - 2];
      value = low < high ? log_between(random, low, high) : low;
    }
  }
  return injection;
}

std::optional<Hidden> drawn_effect(const Model& model, const Series& logged, Random& random) {
  const Effect& effect = *find_effect(one_of(random, kDriven), Level::series);
  const std::vector<std::vector<std::string>> bindings = bindings_of(effect, model, logged);
  if (bindings.empty()) return std::nullopt;
  const BoundEffect bound{&effect, one_of(random, bindings)};
  if (has_term(model, effect, bound.columns)) return std::nullopt;
  if (!inputs_of(effect, bound.columns, logged).usable) return std::nullopt;
  const Injection injection = drawn_injection(bound, logged, random);
  if (std::any_of(injection.parameters.begin(), injection.parameters.end(), [](double v) { return !(v != 0.0); })) {
    return std::nullopt;  // a threshold of a signal that never rises
  }
  return Hidden{label_of(bound), bound, {}, signal_of(injection, logged), injection.parameters};
}

Hidden drawn_outsider(const Series& sensors, Random& random) {
  const std::vector<double>& speed_rpm = values_of(sensors, "speed_rpm");
  switch (index_below(random, 4)) {
    case 0: {
      const std::vector<double>& room = values_of(sensors, "T_room_degC");
      std::vector<double> signal;
      for (std::size_t i = 0; i < room.size(); ++i) signal.push_back(speed_rpm[i] * (room[i] - room.front()));
      return {"speed times the rise of T_room_degC", std::nullopt, {}, std::move(signal)};
    }
    case 1:
      return {
          "a machine that switches on and off, not logged", std::nullopt, {}, unlogged_machine(sensors.time_s, random)};
    case 2:
      return {"the square of the rate of T_front_degC", std::nullopt, {}, squared_rate(sensors, "T_front_degC")};
    default:
      break;
  }
  double at_rpm = 0.0;
  while (at_rpm == 0.0) at_rpm = one_of(random, speed_rpm);
  std::vector<double> signal;
  for (const double rpm : speed_rpm) {
    const double away = (rpm - at_rpm) / 500.0;
    signal.push_back(std::exp(-away * away));
  }
  return {fmt::format("a resonance at {:g} rpm", at_rpm), std::nullopt, {}, std::move(signal)};
}

std::vector<Hidden> drawn_causes(const Workshop& workshop, std::string_view target, Random& random) {
  std::vector<std::string> names{"z_centrifugal_um", "z_rings_um", "z_housing_um", "z_structure_um"};
  if (target == "y_um") names = {"y_structure_um", "y_bending_um"};
  for (std::size_t i = names.size(); i > 1; --i) std::swap(names[i - 1], names[index_below(random, i)]);
  std::vector<Hidden> causes;
  causes.reserve(names.size());
  for (const std::string& name : names) {
    causes.push_back({fmt::format("{} of a finite-volume spindle", name.substr(0, name.size() - 3)), std::nullopt,
                      match_of(name), values_of(workshop.causes, name)});
  }
  return causes;
}

}  // namespace ballbar::blind

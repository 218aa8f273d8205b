#include <fmt/format.h>

#include <algorithm>

#include "ballbar/internal/numerics/range.hpp"
#include "challenge/blind_parts.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "model/bindings.hpp"

namespace ballbar::blind {
namespace {

const std::vector<double>& values_of(const Series& series, std::string_view column) {
  return find_column(series, column)->values;
}

// A machine that nobody logs, and how slowly what it heats follows.
struct UnloggedMachine {
  double follows_s = 0.0, stays_s = 0.0;
};

// A drive of 0 and 1 at times of its own, seen through that body.
std::vector<double> unlogged_machine(const UnloggedMachine& machine, const std::vector<double>& time_s,
                                     Random& random) {
  std::vector<double> signal;
  double on = 0.0, state = 0.0, last_s = time_s.front();
  double next_s = time_s.front() + machine.stays_s * between(random, 0.3, 1.7);
  for (const double now_s : time_s) {
    state = on + (state - on) * std::exp(-(now_s - last_s) / machine.follows_s);
    if (now_s >= next_s) {
      on = 1.0 - on;
      next_s = now_s + machine.stays_s * between(random, 0.3, 1.7);
    }
    last_s = now_s;
    signal.push_back(state);
  }
  return signal;
}

std::vector<double> room_by_speed(const Series& sensors) {
  const std::vector<double>&speed_rpm = values_of(sensors, "speed_rpm"), &room = values_of(sensors, "T_room_degC");
  std::vector<double> signal;
  signal.reserve(room.size());
  for (std::size_t i = 0; i < room.size(); ++i) signal.push_back(speed_rpm[i] * (room[i] - room.front()));
  return signal;
}

std::vector<double> resonance(const Series& sensors, double at_rpm) {
  std::vector<double> signal;
  for (const double rpm : values_of(sensors, "speed_rpm")) {
    const double away = (rpm - at_rpm) / 500.0;
    signal.push_back(std::exp(-away * away));
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

// A cause as a column of Workshop::causes, and the sensors of the parts that make it.
struct SpindlePart {
  std::string_view column;
  SpindleCause cause;
  std::vector<std::string> sensors;
};

std::vector<SpindlePart> parts_of(std::string_view target) {
  const std::vector<std::string> structure{"T_head_degC", "T_column_degC", "T_room_degC"};
  const std::vector<std::string> housing{"T_front_degC", "T_rear_degC", "T_motor_degC", "T_housing_degC",
                                         "T_coolant_degC"};
  if (target == "y_um") {
    std::vector<std::string> bending = housing;
    bending.emplace_back("T_head_degC");
    return {{"y_structure_um", SpindleCause::structure, structure}, {"y_bending_um", SpindleCause::bending, bending}};
  }
  return {{"z_centrifugal_um", SpindleCause::centrifugal, {}},
          {"z_rings_um", SpindleCause::rings, {"T_front_degC", "T_rear_degC"}},
          {"z_housing_um", SpindleCause::housing, housing},
          {"z_structure_um", SpindleCause::structure, structure}};
}

// Every choice of different sensors for so many inputs, the last of them fastest.
std::vector<std::vector<std::string>> choices_of(const std::vector<std::string>& sensors, std::size_t inputs) {
  std::vector<std::vector<std::string>> choices{{}};
  for (std::size_t k = 0; k < inputs; ++k) {
    std::vector<std::vector<std::string>> longer;
    for (const std::vector<std::string>& choice : choices) {
      for (const std::string& sensor : sensors) {
        if (std::find(choice.begin(), choice.end(), sensor) != choice.end()) continue;
        longer.push_back(choice);
        longer.back().push_back(sensor);
      }
    }
    choices = std::move(longer);
  }
  return choices;
}

// Those of few inputs first, choice of sensors by choice; last, by name, those that match on any columns.
std::vector<BoundEffect> match_of(const SpindlePart& part) {
  const auto explains = [&](const Effect& effect, bool on_its_sensors) {
    return effect.level == Level::series &&
           std::any_of(effect.rules.explains.begin(), effect.rules.explains.end(), [&](const ExplainedCause& one) {
             return one.cause == part.cause && one.on_its_sensors == on_its_sensors;
           });
  };
  std::size_t most = 0;
  for (const auto& effect : built_in_catalogue()) {
    if (explains(*effect, true)) most = std::max(most, effect->inputs.size());
  }
  std::vector<BoundEffect> match;
  for (std::size_t inputs = 1; inputs <= most; ++inputs) {
    for (const std::vector<std::string>& choice : choices_of(part.sensors, inputs)) {
      for (const auto& effect : built_in_catalogue()) {
        if (explains(*effect, true) && effect->inputs.size() == inputs) match.push_back({effect.get(), choice});
      }
    }
  }
  const auto on_any = static_cast<std::ptrdiff_t>(match.size());
  for (const auto& effect : built_in_catalogue()) {
    if (explains(*effect, false)) match.push_back({effect.get(), {}});
  }
  std::sort(match.begin() + on_any, match.end(),
            [](const BoundEffect& a, const BoundEffect& b) { return a.effect->name < b.effect->name; });
  return match;
}

}  // namespace

Injection drawn_injection(const BoundEffect& bound, const Series& logged, Random& random) {
  Injection injection = injection_of(bound, logged);
  const BoundInputs inputs = inputs_of(*bound.effect, bound.columns, logged);
  for (std::size_t k = 0; k < injection.parameters.size(); ++k) {
    const Parameter& parameter = bound.effect->parameters[k];
    double& value = injection.parameters[k];
    if (parameter.kind == ParameterKind::gain) {
      value = chance(random, 0.5) ? 1.0 : -1.0;
    } else if (parameter.usual_on) {
      value = parameter.usual_on(inputs.rows, simulation::uniform(random));
    } else if (!parameter.held && parameter.grid.size() > 2) {
      const double low = std::max(parameter.grid[1], 1e-9), high = parameter.grid[parameter.grid.size() - 2];
      value = low < high ? log_between(random, low, high) : low;
    }
  }
  return injection;
}

std::optional<HiddenEffect> drawn_effect(const Model& model, const Series& logged, Random& random) {
  std::vector<const Effect*> hidden;
  for (const auto& effect : built_in_catalogue()) {
    if (effect->level == Level::series && effect->rules.is_common) hidden.push_back(effect.get());
  }
  if (hidden.empty()) return std::nullopt;
  const Effect& effect = *one_of(random, hidden);
  const std::vector<std::vector<std::string>> bindings = bindings_of(effect, model, logged);
  if (bindings.empty()) return std::nullopt;
  const BoundEffect bound{&effect, one_of(random, bindings)};
  if (has_term(model, effect, bound.columns)) return std::nullopt;
  if (!inputs_of(effect, bound.columns, logged).usable) return std::nullopt;
  const Injection injection = drawn_injection(bound, logged, random);
  if (std::any_of(injection.parameters.begin(), injection.parameters.end(), [](double v) { return !(v != 0.0); })) {
    return std::nullopt;  // a threshold of a signal that never rises
  }
  std::vector<double> signal = signal_of(injection, logged);
  return HiddenEffect{label_of(bound), bound, {}, std::move(signal)};
}

HiddenEffect drawn_outsider(const Series& sensors, Random& random) {
  switch (index_below(random, 4)) {
    case 0:
      return {"speed times the rise of T_room_degC", std::nullopt, {}, room_by_speed(sensors)};
    case 1: {
      const double follows_s = log_between(random, 300.0, 5400.0);
      const double stays_s = (sensors.time_s.back() - sensors.time_s.front()) / between(random, 4.0, 10.0);
      return {"a machine that switches on and off, not logged",
              std::nullopt,
              {},
              unlogged_machine({follows_s, stays_s}, sensors.time_s, random)};
    }
    case 2:
      return {"the square of the rate of T_front_degC", std::nullopt, {}, squared_rate(sensors, "T_front_degC")};
    default:
      break;
  }
  double at_rpm = 0.0;
  while (at_rpm == 0.0) at_rpm = one_of(random, values_of(sensors, "speed_rpm"));
  return {fmt::format("a resonance at {:g} rpm", at_rpm), std::nullopt, {}, resonance(sensors, at_rpm)};
}

std::vector<HiddenEffect> drawn_causes(const Workshop& workshop, std::string_view target, Random& random) {
  std::vector<SpindlePart> parts = parts_of(target);
  for (std::size_t i = parts.size(); i > 1; --i) std::swap(parts[i - 1], parts[index_below(random, i)]);
  std::vector<HiddenEffect> causes;
  causes.reserve(parts.size());
  for (const SpindlePart& part : parts) {
    const std::string_view name = part.column.substr(0, part.column.size() - 3);  // without its unit
    causes.push_back({fmt::format("{} of a finite-volume spindle", name), std::nullopt, match_of(part),
                      values_of(workshop.causes, part.column)});
  }
  return causes;
}

}  // namespace ballbar::blind

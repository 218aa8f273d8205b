#include "ballbar/compensation/compensation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "ballbar/error.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kLatest_s = 1e12;  // doubles still tell 0.1 ms there
constexpr std::array<std::string_view, kHoldKinds> kHolds{"none",    "no_value",   "spike",     "stuck", "out_of_range",
                                                          "no_time", "clock_back", "clock_gap", "model"};

void expect_limit(bool holds, std::string_view name, std::string_view expected, double found) {
  if (!holds) throw Error(fmt::format("{}: expected {}, found {}.", name, expected, found));
}

const Model& checked_model(const Model& model) {
  if (model.targets.size() != 1) {
    throw Error(fmt::format("expected a model of one target, found {}: each axis has a compensator of its own.",
                            model.targets.size()));
  }
  if (unit_of(model.targets.front()) != "um") {
    throw Error(fmt::format("expected a target in um, which moves an axis, found {}.", model.targets.front()));
  }
  for (const ColumnRange& range : model.trained) {
    const bool read = std::any_of(model.terms.begin(), model.terms.end(), [&](const Term& term) {
      return std::find(term.columns.begin(), term.columns.end(), range.column) != term.columns.end();
    });
    if (read) continue;
    throw Error(
        fmt::format("[trained]: expected columns that an effect reads, found {}, which none does.", range.column));
  }
  return model;
}

CompensationLimits checked_limits(const CompensationLimits& limits) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  expect_limit(positive(limits.resolution_um), "resolution", "a least increment above 0 um", limits.resolution_um);
  expect_limit(limits.hysteresis >= 0.0 && limits.hysteresis <= 10.0, "hysteresis", "0 to 10 increments",
               limits.hysteresis);
  expect_limit(positive(limits.rate_um_per_s), "rate", "above 0 um/s", limits.rate_um_per_s);
  expect_limit(limits.step_um >= limits.resolution_um && std::isfinite(limits.step_um), "step",
               fmt::format("at least the resolution of {} um", limits.resolution_um), limits.step_um);
  expect_limit(limits.largest_um >= limits.resolution_um && std::isfinite(limits.largest_um), "largest offset",
               fmt::format("at least the resolution of {} um", limits.resolution_um), limits.largest_um);
  expect_limit(limits.largest_um <= 1e9 * limits.resolution_um, "largest offset", "at most 1e9 increments",
               limits.largest_um);
  expect_limit(limits.range_margin >= 0.0, "range margin", "at least 0", limits.range_margin);
  expect_limit(limits.spike_K > 0.0, "spike", "above 0 K", limits.spike_K);
  expect_limit(limits.heating_K_per_s >= 0.0, "heating", "at least 0 K/s", limits.heating_K_per_s);
  expect_limit(limits.stuck_s > 0.0, "stuck", "above 0 s", limits.stuck_s);
  expect_limit(limits.gap_s > 0.0, "gap", "above 0 s", limits.gap_s);
  return limits;
}

}  // namespace

double whole_increments(double length_um, double resolution_um) {
  return std::floor(length_um / resolution_um * (1.0 + 1e-12));
}

std::string_view name_of(Hold hold) { return kHolds[static_cast<std::size_t>(hold)]; }

bool is_about_a_column(Hold hold) {
  return hold == Hold::no_value || hold == Hold::spike || hold == Hold::stuck || hold == Hold::out_of_range;
}

Compensator::Compensator(const Model& model, const CompensationLimits& limits)
    : limits_(checked_limits(limits)), model_(checked_model(model)) {
  for (const std::string& column : columns()) {
    const auto trained = std::find_if(model.trained.begin(), model.trained.end(),
                                      [&](const ColumnRange& range) { return range.column == column; });
    Range range;
    if (trained != model.trained.end()) {
      const double margin = limits.range_margin * (trained->high - trained->low);
      range = {trained->low - margin, trained->high + margin};
    }
    ranges_.push_back(range);
    temperatures_.push_back(unit_of(column) == "degC" || unit_of(column) == "K");
  }
  state_.resolution_um = limits.resolution_um;
  state_.sensors.resize(columns().size());
}

Offset Compensator::next(double time_s, std::span<const double> values) {
  assert(values.size() == columns().size());
  Hold hold = Hold::none;
  const std::optional<double> elapsed_s = follows(time_s, hold);
  if (!elapsed_s) return offset(hold, 0, kUnknown, false);
  std::size_t bad = 0;
  bool only_spikes = true;
  for (std::size_t c = 0; c < values.size(); ++c) {
    Sensor& sensor = state_.sensors[c];
    if (!(values[c] == sensor.read)) {
      sensor.read = values[c];
      sensor.unchanged_since_s = state_.time_s;
    }
    const Hold why = hold_of(c, state_.time_s, values[c]);
    if (why == Hold::none || why == Hold::stuck) {
      sensor.believed = values[c];
      sensor.believed_s = state_.time_s;
    }
    only_spikes &= why == Hold::none || why == Hold::spike;
    if (hold != Hold::none || why == Hold::none) continue;
    hold = why;
    bad = c;
  }
  if (hold == Hold::spike && only_spikes && state_.believed == 1 && ++state_.contradicted == 2) {
    begin_anew(values);
    hold = Hold::none;
  }
  if (hold != Hold::none) return offset(hold, bad, kUnknown, false);
  const double model_um = model_.next(state_.time_s, values);
  if (!std::isfinite(model_um)) return offset(Hold::model, 0, kUnknown, false);
  if (!state_.started) state_.origin_um = model_um;
  state_.started = true;
  state_.believed = std::min(state_.believed + 1, 2);
  state_.contradicted = 0;
  const double error_um = model_um - state_.origin_um;
  const double target_um = std::clamp(-error_um, -limits_.largest_um, limits_.largest_um);
  walk(target_um, *elapsed_s);
  return offset(Hold::none, 0, error_um, state_.offset_um != -error_um);
}

// Time since the last row with a valid time; sets state_.time_s. nullopt, and why, if this row does not continue it.
std::optional<double> Compensator::follows(double time_s, Hold& why) {
  if (!(std::abs(time_s) <= kLatest_s)) {
    why = Hold::no_time;
    return std::nullopt;
  }
  const double now_s = time_s + state_.clock_s;
  const double elapsed_s = state_.timed ? now_s - state_.time_s : 0.0;
  const bool back = state_.timed && !(elapsed_s > 0.0);
  if (!back && elapsed_s <= std::max(limits_.gap_s, 2.0 * state_.pace_s)) {
    if (state_.timed) state_.pace_s = elapsed_s;
    state_.timed = true;
    state_.doubtful_s = kUnknown;
    state_.time_s = now_s;
    return elapsed_s;
  }
  const double since_doubtful_s = time_s - state_.doubtful_s;
  const double pace_s = back ? 0.0 : elapsed_s - since_doubtful_s;  // to the row in doubt
  if (!(since_doubtful_s > 0.0 && since_doubtful_s <= std::max(limits_.gap_s, 2.0 * pace_s))) {
    state_.doubtful_s = time_s;
    why = back ? Hold::clock_back : Hold::clock_gap;
    return std::nullopt;
  }
  if (!back) {  // nothing came for that long
    for (Sensor& sensor : state_.sensors) sensor.unchanged_since_s = now_s;
    state_.doubtful_s = kUnknown;
    state_.pace_s = since_doubtful_s;
    state_.time_s = now_s;
    return elapsed_s;
  }
  if (!(state_.time_s + since_doubtful_s > state_.time_s)) {  // too little to be told that far from 0
    why = Hold::clock_back;
    return std::nullopt;
  }
  state_.doubtful_s = kUnknown;
  state_.time_s += since_doubtful_s;
  state_.clock_s = state_.time_s - time_s;
  return since_doubtful_s;
}

// The zero is the row at hand; the offset stays.
void Compensator::begin_anew(std::span<const double> values) {
  for (std::size_t c = 0; c < values.size(); ++c) {
    state_.sensors[c].believed = values[c];
    state_.sensors[c].believed_s = state_.time_s;
  }
  model_.begin_anew();
  state_.started = false;
  state_.believed = 0;
}

Hold Compensator::hold_of(std::size_t column, double time_s, double value) const {
  if (!std::isfinite(value)) return Hold::no_value;
  if (value < ranges_[column].low || value > ranges_[column].high) return Hold::out_of_range;
  if (!temperatures_[column]) return Hold::none;
  const Sensor& sensor = state_.sensors[column];
  const double likely_K = limits_.spike_K + limits_.heating_K_per_s * (time_s - sensor.believed_s);
  if (std::abs(value - sensor.believed) > likely_K) return Hold::spike;
  return time_s - sensor.unchanged_since_s > limits_.stuck_s ? Hold::stuck : Hold::none;
}

void Compensator::walk(double target_um, double elapsed_s) {
  const double step =
      whole_increments(limits_.step_um, limits_.resolution_um);  // as the counts, which would fall behind else
  const double most_um = std::min(step * limits_.resolution_um, limits_.rate_um_per_s * elapsed_s);
  const double way_um = target_um - state_.offset_um;
  state_.offset_um = std::abs(way_um) <= most_um ? target_um : state_.offset_um + std::copysign(most_um, way_um);
  const double increments = state_.offset_um / limits_.resolution_um;
  const double counts = static_cast<double>(state_.counts);
  if (std::abs(increments - counts) <= 0.5 + limits_.hysteresis) return;
  const double largest = whole_increments(limits_.largest_um, limits_.resolution_um);
  const double next = std::clamp(std::round(increments), counts - step, counts + step);
  state_.counts = static_cast<std::int64_t>(std::clamp(next, -largest, largest));
}

Offset Compensator::offset(Hold hold, std::size_t column, double predicted_um, bool limited) const {
  return {state_.counts, static_cast<double>(state_.counts) * limits_.resolution_um, predicted_um, hold, column,
          limited};
}

void Compensator::resume(const State& state, const LiveModel::State& model) {
  if (state.sensors.size() != columns().size()) {
    throw Error(
        fmt::format("expected the state of {} columns, found one of {}.", columns().size(), state.sensors.size()));
  }
  if (state.resolution_um != limits_.resolution_um) {
    throw Error(fmt::format("expected the state of a resolution of {} um, found one of {} um.", limits_.resolution_um,
                            state.resolution_um));
  }
  const double largest = whole_increments(limits_.largest_um, limits_.resolution_um);
  if (!(std::abs(state.offset_um) <= limits_.largest_um) || std::abs(static_cast<double>(state.counts)) > largest) {
    throw Error(fmt::format("expected an offset of at most {} um, found {} um, {} increments.", limits_.largest_um,
                            state.offset_um, state.counts));
  }
  const double difference = std::abs(state.offset_um / limits_.resolution_um - static_cast<double>(state.counts));
  if (difference > 1.5 + limits_.hysteresis + limits_.step_um / limits_.resolution_um) {
    throw Error(fmt::format("expected counts near the offset of {} um, found {}.", state.offset_um, state.counts));
  }
  for (const double number : {state.time_s, state.clock_s, state.origin_um, state.pace_s}) {
    if (!std::isfinite(number)) throw Error(fmt::format("expected finite times and origin, found {}.", number));
  }
  if (const std::size_t rows = std::min(model.rows, model.time_s.size());
      rows > 0 && !(model.time_s[rows - 1] <= state.time_s)) {
    throw Error(fmt::format("expected the model's rows up to {} s, the time of the last row, found one at {} s.",
                            state.time_s, model.time_s[rows - 1]));
  }
  model_.resume(model);
  state_ = state;
}

}  // namespace ballbar

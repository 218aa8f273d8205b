// The measurement that would separate errors which recordings do not tell apart.
//
// The share of the square of an error's curve that no combination of the circles and the other errors imitates is
// 1 / (N C) of that error, N = X' X over the readings and C its inverse. Below 2 % the readings do not tell the error
// from the others. Each recording is then repeated as the measurement would have it, with a circle of its own. If a
// share rises to 10 % or more, the measurement separates that error.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ballbar/effects/effect.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

enum class Measurement { other_direction, full_circle, another_feed };
std::string_view name_of(Measurement measurement);  // "other_direction"

struct NextMeasurement {
  Measurement measurement = Measurement::other_direction;
  std::string error, other;  // names of the two that it separates best, "servo_mismatch", "centre_a"
};

struct ShapedEffect {
  const Effect* effect = nullptr;
  double shape = 0.0;  // of an effect that has one
};

// Of trace_of() recordings. The first Measurement that separates one of the effects; nullopt: all are separate, none of
// these measurements helps, or there are more than 24 recordings.
std::optional<NextMeasurement> next_measurement(const Series& trace, std::span<const ShapedEffect> effects);

}  // namespace ballbar

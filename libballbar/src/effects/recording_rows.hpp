// Common parts of the effects on recordings: their inputs, and the state of the two axes at a reading.
#pragma once

#include <ceres/jet.h>

#include <cmath>

#include "ballbar/effects/effect.hpp"
#include "ballbar/units.hpp"

namespace ballbar {

inline Input angle_input() { return {"angle", {"rad"}, "angle of the reading, from +A towards +B"}; }
inline Input direction_input() { return {"direction", {"1"}, "+1 counter-clockwise (CCW), -1 clockwise (CW)"}; }
inline Input feed_input() { return {"feed", {"mm_per_min"}, "feed along the path"}; }
inline Input radius_input() { return {"radius", {"mm"}, "nominal length of the bar"}; }
inline Input height_input() { return {"height", {"mm"}, "height difference of the balls"}; }
inline Input sweep_input() { return {"sweep", {"s"}, "time since the middle of the sweep"}; }
inline Input recording_input() { return {"recording", {"1"}, "number of the recording: 0, 1 ..."}; }
inline Input bar_input() { return {"bar", {"degC"}, "temperature of the bar"}; }

inline Parameter recording_parameter() {
  return {
      "recording",       "1", ParameterKind::shape, -1.0, -1.0, 1e6, {}, "which recording it belongs to; -1: all", true,
      ShapeOf::recording};
}

// Whether a row belongs to the recording `chosen` of a term; -1: all rows.
template <class T>
bool belongs_to(const T& chosen, double recording) {
  return chosen < T(-0.5) || (chosen > T(recording - 0.5) && chosen < T(recording + 0.5));
}

enum class Axis { A, B };

// One axis of the plane at a reading: its position, that of the other axis (both over the radius), and its direction of
// motion: +1, -1, 0 at a reversal.
//
//   A: cos theta, other sin theta, velocity - dir sin theta        B: sin theta, other cos theta, velocity dir cos
//   theta
struct AxisState {
  double position;
  double across;
  double velocity_sign;
};

inline AxisState state_of(Axis axis, double angle_rad, double direction) {
  const double cos = std::cos(angle_rad), sin = std::sin(angle_rad);
  const double velocity = axis == Axis::A ? -direction * sin : direction * cos;
  constexpr double kStandsStill = 1e-12;  // cos and sin of a quarter turn are not quite 0
  const double sign = velocity > kStandsStill ? 1.0 : velocity < -kStandsStill ? -1.0 : 0.0;
  return axis == Axis::A ? AxisState{cos, sin, sign} : AxisState{sin, cos, sign};
}

// The last reversal of an axis before a reading: A reverses at 0 (+ end) and 180 deg, B at 90 (+ end) and 270 deg.
struct Reversal {
  double since_deg;  // angle travelled since, 0 to 180 deg
  bool positive_end;
};

inline Reversal last_reversal(Axis axis, double angle_rad, double direction) {
  const double phi_rad = direction * (angle_rad - (axis == Axis::A ? 0.0 : kPi / 2.0));
  const double half_turns = std::floor(phi_rad / kPi);
  return {deg_from_rad(phi_rad - half_turns * kPi), std::fmod(std::abs(half_turns), 2.0) < 0.5};
}

}  // namespace ballbar

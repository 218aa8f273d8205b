#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "ballbar/units.hpp"
#include "effects/evaluate.hpp"
#include "effects/grids.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// (s / 2 sin(2 pi x / p) + c / 2 cos(2 pi x / p)) x / R, x the axis' position from the circle's centre; s and c of
// their own forwards (fwd) and backwards (rev), so that the amplitude is from peak to peak
struct CyclicError {
  Axis axis;

  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    using std::cos, std::sin;
    const std::span<const double> angle_rad = rows.inputs[0], radius_mm = rows.inputs[1], direction = rows.inputs[2];
    const AxisState state = state_of(axis, angle_rad[i], direction[i]);
    const T* wave = state.velocity_sign < 0.0 ? p + 2 : p;
    const T phase_rad = 2.0 * kPi * radius_mm[i] * state.position / p[4];
    return 0.5 * state.position * (wave[0] * sin(phase_rad) + wave[1] * cos(phase_rad));
  }
};

// sin and cos of 2 pi t to 1e-14, several times faster than those of the standard library. Beyond whole turns the angle
// is within pi; an eighth of it is within pi / 8, where their series to the 11th and 12th power are exact to rounding;
// and then the angle is doubled three times.
void sin_cos_of_turns(const Eigen::ArrayXd& turns, Eigen::ArrayXd& sin, Eigen::ArrayXd& cos) {
  constexpr double kNoFraction = 0x1.8p52;  // what is added to it is rounded to whole numbers
  for (Eigen::Index i = 0; i < turns.size(); ++i) {
    const double whole = (turns[i] + kNoFraction) - kNoFraction;
    const double angle = 0.25 * kPi * (turns[i] - whole), square = angle * angle;
    double s = 1.0, c = 1.0;
    for (int k = 11; k > 1; k -= 2) s = 1.0 - square * (1.0 / (k * (k - 1))) * s;
    for (int k = 12; k > 0; k -= 2) c = 1.0 - square * (1.0 / (k * (k - 1))) * c;
    s *= angle;
    for (int doubled = 0; doubled < 3; ++doubled) {
      const double of_half = s;
      s = 2.0 * s * c;
      c = 1.0 - 2.0 * of_half * of_half;
    }
    sin[i] = s;
    cos[i] = c;
  }
}

// Of the unit curves what does not depend on the pitch: the position, mm, and half of it over the radius, 0 while the
// axis moves the other way.
UnitCurvesAt unit_curves(Axis axis, const EffectRows& rows) {
  const auto n = static_cast<Eigen::Index>(rows.time_s.size());
  Eigen::ArrayXd x_mm(n), fwd = Eigen::ArrayXd::Zero(n), rev = fwd;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(i);
    const AxisState state = state_of(axis, rows.inputs[0][row], rows.inputs[2][row]);
    x_mm[i] = rows.inputs[1][row] * state.position;
    (state.velocity_sign < 0.0 ? rev : fwd)[i] = 0.5 * state.position;
  }
  return [=, sin = Eigen::ArrayXd(n), cos = Eigen::ArrayXd(n)](double pitch_mm, double* curves) mutable {
    sin_cos_of_turns(x_mm / pitch_mm, sin, cos);
    Eigen::Map<Eigen::ArrayXXd> columns(curves, n, 4);
    columns.col(0) = fwd * sin;
    columns.col(1) = fwd * cos;
    columns.col(2) = rev * sin;
    columns.col(3) = rev * cos;
  };
}

Evaluate evaluated(Axis axis) {
  Evaluate evaluate = by_reading<5>(CyclicError{axis});
  evaluate.unit_curves = [axis](const EffectRows& rows) { return unit_curves(axis, rows); };
  return evaluate;
}

constexpr double kFinest_mm = 2.0;  // searched

// Over the travel from end to end.
std::vector<double> pitches(const EffectRows& rows, double lower, double upper, std::size_t most) {
  const std::span<const double> radius_mm = rows.inputs[1];
  const double travel_mm = 2.0 * *std::max_element(radius_mm.begin(), radius_mm.end());
  return wave_lengths(std::max(lower, kFinest_mm), upper, travel_mm, most);
}

Effect cyclic_error(Axis axis) {
  const bool a = axis == Axis::A;
  return {
      a ? "cyclic_error_a" : "cyclic_error_b",
      Level::recording,
      {.summary = a ? "The error of axis A repeats with every turn of its screw."
                    : "The error of axis B repeats with every turn of its screw.",
       .cause =
           "A ball screw that runs out or wobbles, an encoder or coupling off centre, or interpolation of a scale.",
       .formula =
           "(sine sin(2 pi x / pitch) + cosine cos(2 pi x / pitch)) x / (2 R), x the position of the axis; _fwd while "
           "it moves towards +, _rev towards -",
       .signature = "A wave fixed to the axis position: long near the reversals, short where the axis is fast, and "
                    "zero at the middle of the travel.",
       .on_parts = a ? "An interpolated circle has waves, longest near 0 and 180 deg. Bored and drilled holes are off "
                       "along A by up to half the value: two holes half a pitch apart by up to the value, two holes a "
                       "whole number of pitches apart not at all."
                     : "An interpolated circle has waves, longest near 90 and 270 deg. Bored and drilled holes are off "
                       "along B by up to half the value: two holes half a pitch apart by up to the value, two holes a "
                       "whole number of pitches apart not at all.",
       .confused_with = {"vibration", "lobing", a ? "cyclic_error_b" : "cyclic_error_a"},
       .separated_by = "Measure at another feed: a cyclic error stays in place, a vibration moves along the path.",
       .remedy = "Check bearing and alignment of the screw, the coupling and the mounting of the encoder.",
       .validity = "Linear axes; one wave of one pitch, equal in all recordings.",
       .source = "Periodic error along the axis; pitch and phase as AF_CYCLIC_PITCH and AF_CYCLIC_PHASE of measured "
                 ".b5r files."},
      {angle_input(), radius_input(), direction_input()},
      {gain_within("sine_fwd_um", "um", 1000.0, "sine part while it moves towards +, peak to peak", "fwd"),
       gain_within("cosine_fwd_um", "um", 1000.0, "cosine part of it", "fwd"),
       gain_within("sine_rev_um", "um", 1000.0, "sine part while it moves towards -, peak to peak", "rev"),
       gain_within("cosine_rev_um", "um", 1000.0, "cosine part of it", "rev"),
       {"pitch_mm",
        "mm",
        ParameterKind::shape,
        10.0,
        0.5,
        200.0,
        {kFinest_mm, 3.0,  4.0,  5.0,  6.0,  8.0,  10.0, 12.0, 12.5, 14.0,
         15.0,       16.0, 18.0, 20.0, 22.0, 25.0, 30.0, 32.0, 40.0, 50.0},
        "wavelength in travel, usually the screw lead",
        false,
        ShapeOf::curve,
        pitches}},
      evaluated(axis),
      false,
      {Motion::linear_axes},
      {.error_fit = ErrorFit::along_the_travel, .reversal_deg = a ? 0.0 : 90.0},
  };
}

}  // namespace

extern const Effect kCyclicErrorA = cyclic_error(Axis::A);
extern const Effect kCyclicErrorB = cyclic_error(Axis::B);

}  // namespace ballbar::catalogue

// Common parts of the effects on a drift series.
#pragma once

#include <ceres/jet.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/units.hpp"
#include "effects/evaluate.hpp"
#include "effects/grids.hpp"

namespace ballbar {

// Whether a column can be the temperature of a part inside the spindle.
inline bool is_inside(const Column& column) { return column.role != Role::ambient && column.role != Role::coolant; }

// The causes of a finite-volume spindle that thermal expansion of a body explains.
inline std::vector<ExplainedCause> expansion_causes() {
  return {{SpindleCause::rings, true},
          {SpindleCause::housing, true},
          {SpindleCause::structure, true},
          {SpindleCause::bending, true}};
}

// n^a with n in krpm; 0 at rest, whatever the exponent. The sign of the speed (its direction) does not matter.
template <class T>
T power_of_speed(double speed_rpm, const T& exponent) {
  using std::exp;
  const double krpm = std::abs(speed_rpm) / 1000.0;
  if (krpm < 1e-9) return T(0.0);
  return exp(exponent * std::log(krpm));
}

// A sine of unknown phase, for cycles without a logged input:
// a cos 2 pi t / P + b sin 2 pi t / P, t since the first row; parameters a, b, P.
struct Cycle {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    using std::cos;
    using std::sin;
    const T turns = (rows.time_s[i] - rows.time_s[0]) / p[2];
    const T phase = 2.0 * kPi * turns;
    return p[0] * cos(phase) + p[1] * sin(phase);
  }
};

// As many as the length of the rows can resolve.
inline std::vector<double> cycle_periods(const EffectRows& rows, double lower, double upper, std::size_t most) {
  return wave_lengths(lower, upper, range_in(rows.time_s), most);
}

inline std::vector<Parameter> cycle_parameters(double period_s, double lower_s, double upper_s,
                                               std::vector<double> grid_s, const char* meaning, bool held) {
  return {gain_within("cosine_um", "um", 1000.0, "cosine amplitude, largest at the first row"),
          gain_within("sine_um", "um", 1000.0, "sine amplitude, 0 at the first row and rising"),
          {"period_s", "s", ParameterKind::shape, period_s, lower_s, upper_s, std::move(grid_s), meaning, held,
           ShapeOf::period, cycle_periods}};
}

}  // namespace ballbar

// A sine of unknown phase, for cycles without a logged input.
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

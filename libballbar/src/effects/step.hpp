// A step with an onset that can be fitted; shared by `step` and `mounting_slip`.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

// k H_i, where H_i is the share of the interval from row i - 1 to row i that lies after the onset: 0 before it, 1 after
// it. An onset at the time of a row gives an exact step just after that row. Between two rows one row has a partial
// value, so that value and derivative agree and a solver can move the onset within the interval. Longer moves need a
// search over the times of the rows. The first row uses the interval of the second.
struct Step {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> time_s = rows.time_s;
    const std::size_t end = std::min(std::max<std::size_t>(i, 1), time_s.size() - 1);
    const double width_s = end > 0 ? time_s[end] - time_s[end - 1] : 1.0;
    const T share = (time_s[i] - p[1]) / width_s;
    if (!(share > T(0.0))) return T(0.0);
    return share > T(1.0) ? p[0] : p[0] * share;
  }
};

}  // namespace ballbar

// Numbers that are none.
#pragma once

#include <limits>

namespace ballbar {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace ballbar

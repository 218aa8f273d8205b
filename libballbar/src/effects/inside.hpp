// Whether a column can be the temperature of a part inside the spindle; shared by the effects of its bearings.
#pragma once

#include "ballbar/series/series.hpp"

namespace ballbar {

inline bool is_inside(const Column& column) { return column.role != Role::ambient && column.role != Role::coolant; }

}  // namespace ballbar

// Names that HAL has: of pins, from names of columns, and of axes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ballbar/compensation/compensation.hpp"

namespace ballbar::hal {

// "T_xi_degC" is "ballbar.signal.T-xi-degC", as HAL writes names. Throws Error: a character that no HAL name should
// have, a name longer than the 47 characters HAL takes, two columns with one name.
std::vector<std::string> signal_pins(const std::string& component, std::span<const std::string> columns);

// The names of the axes, which are letters, in their order. Throws Error: another name than x y z u v w, for an offset
// is a length and a b c are angles.
std::string letters_of(std::span<const CompensatedAxis> axes);

}  // namespace ballbar::hal

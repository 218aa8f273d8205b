// Names of pins from names of columns.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace ballbar::hal {

// "T_xi_degC" is "ballbar.signal.T-xi-degC", as HAL writes names. Throws Error: a character that no HAL name should
// have, a name longer than the 47 characters HAL takes, two columns with one name.
std::vector<std::string> signal_pins(const std::string& component, std::span<const std::string> columns);

}  // namespace ballbar::hal

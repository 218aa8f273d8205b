// Temperatures along a spindle, `.csv`: first column x_mm, then one or more columns in degC, one for each state (a
// time, a speed). A column NAME_sigma_degC is the standard uncertainty of NAME_degC.
//
//   # comments, only here
//   x_mm,T_600s_degC,T_3600s_degC
//   0,30.1,38.2
//   10,29.8,37.9
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/temperature/temperature.hpp"

namespace ballbar {

struct NamedProfile {
  std::string name;  // of the column: T_600s_degC
  TemperatureProfile profile;
};

// At least one profile, in the order of the columns. `name` is used in messages. Throws Error with name:line:column: a
// first column that is not x_mm, another one that does not end in _degC, a sigma without its column or below 0, a cell
// without a number, x that does not rise, less than two rows.
std::vector<NamedProfile> read_profiles(std::string_view bytes, std::string_view name);

// Writes the profiles at the positions of the first one; the others are interpolated linearly. Includes the sigmas of
// profiles that have them. Numbers read back exactly.
std::string write_profiles(const std::vector<NamedProfile>& profiles);

}  // namespace ballbar

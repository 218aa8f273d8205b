// Temperatures along a spindle, `.csv`: first column x_mm, then one or more columns in degC, each one state (a time, a
// speed). A column NAME_sigma_degC is the standard uncertainty of NAME_degC.
//
//   # comments, only here
//   x_mm,T_600s_degC,T_3600s_degC
//   0,30.1,38.2
//   10,29.8,37.9
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/temperature/mean_point.hpp"

namespace ballbar {

struct NamedProfile {
  std::string name;  // of the column: T_600s_degC
  TemperatureProfile profile;
};

// At least one, in the order of the columns. `name` stands in messages. Throws Error with name:line:column: a first
// column that is not x_mm, another that does not end in _degC, a sigma without its column or below 0, no number in a
// cell, x that does not rise, less than two rows.
std::vector<NamedProfile> read_profiles(std::string_view bytes, std::string_view name);

// At the places of the first; the others are straight between theirs. Reads back to the same doubles. Sigmas where a
// profile has them.
std::string write_profiles(const std::vector<NamedProfile>& profiles);

}  // namespace ballbar

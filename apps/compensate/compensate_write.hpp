// `ballbar compensate --write`: a straight line in place of the model, as a file for a control's own temperature
// compensation, and what that costs.
#pragma once

#include <string>
#include <vector>

#include "compensate/compensation_options.hpp"

namespace ballbar {

struct WriteOptions {
  std::string control;           // "siemens", "siemens:2", "siemens:T_a_degC,T_b_degC"; empty: nothing is written
  Source data;                   // what the model is looked at on
  std::vector<std::string> out;  // one, of the control's ending
  bool reversed = false;         // the sign
  bool json = false;
};

// Throws Error as simplified(), control_of() and axes_of(); nothing is written then.
void compensate_write(const CompensationOptions& options, const WriteOptions& write);

}  // namespace ballbar

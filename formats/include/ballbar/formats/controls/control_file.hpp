// A line of compensation as a file for a control's own temperature compensation, by the formula of its manual.
//
//   siemens   SINUMERIK 840D sl, a part program, run once after power on
//             dK = K0(T) + tan beta(T) (P - P0)                               mm
//             Extended Functions, 03/2013, 6FC5397-1BP40-3BA1, K3 4.2. A synchronized action sets K0, which is
//             SD43900 $SA_TEMP_COMP_ABS_VALUE, from readings that the PLC puts into $A_DBR (Basic Functions, 08/2005,
//             6FC5397-0BP10-0BA0, A2 2.2); where one is out of range K0 stays.
//   beckhoff  TwinCAT 3 CNC TF5200 and the ISG kernel, an axis parameter list
//             ds = offset0(T) + coefficient(T) (s - s0)
//             TF5200 Axis Compensation, Temperature compensation; P-AXIS-00271 to 00274. The PLC sets offset0, whole
//             0.1 um, by the formula and the table in the list's comments; readings stop at the ends of their range.
//   linuxcnc  a HAL file of LinuxCNC's own components, for axis.L.eoffset-counts
//             lincurve(9), sum2(9), mux2(9), limit2(9), conv_float_s32(9), of 2.9: counts of -K, a curve of two points
//             a sensor, whose ends hold; while the machine is off or not homed the offset is cleared.
//
// tan beta and coefficient are 0: a drift is measured at one position. K0 and offset0 are the error of the axis, which
// both manuals name so; the pages at hand do not say which way the axis then goes, and the files say how to see it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/compensation/linear_compensation.hpp"

namespace ballbar {

enum class Control { siemens, beckhoff, linuxcnc };

struct ControlKind {
  Control control;
  std::string_view word;    // on the command line
  std::string_view name;    // "SINUMERIK 840D sl"
  std::string_view ending;  // of the file, ".mpf"
};
std::span<const ControlKind> control_kinds();
const ControlKind& kind_of(Control control);

// Throws Error with those there are: another word, or a control whose manual states no formula of temperatures.
Control control_of(std::string_view word);

// What its results are rounded to: resolution_um, and of Beckhoff always 0.1 um.
Increment increment_of(Control control, double resolution_um);

struct ControlLine {
  std::string axis;  // "z"
  LinearCompensation line;
  double rate_um_per_s = 0.2;         // of the offset; of LinuxCNC, the others have limits of their own
  std::vector<std::string> comments;  // lines for the head
};

// Plain ASCII; other characters of the comments and names are ?. Throws Error: for LinuxCNC an axis other than x y z u
// v w.
std::string control_file(Control control, const ControlLine& line);

}  // namespace ballbar

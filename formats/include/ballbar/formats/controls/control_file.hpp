// Writes a linear compensation as a file for the built-in temperature compensation of a control, with the formula of
// its manual.
//
//   siemens   SINUMERIK 840D sl, a part program, run once after power on
//             dK = K0(T) + tan beta(T) (P - P0)                               mm
//             Extended Functions, 03/2013, 6FC5397-1BP40-3BA1, K3 4.2. A synchronized action sets K0, which is
//             SD43900 $SA_TEMP_COMP_ABS_VALUE, from readings that the PLC writes to $A_DBR (Basic Functions, 08/2005,
//             6FC5397-0BP10-0BA0, A2 2.2). If a reading is out of range K0 does not change.
//   beckhoff  TwinCAT 3 CNC TF5200 and the ISG kernel, an axis parameter list
//             ds = offset0(T) + coefficient(T) (s - s0)
//             TF5200 Axis Compensation, Temperature compensation; P-AXIS-00271 to 00274. The PLC sets offset0 in steps
//             of 0.1 um, by the formula and the table in the comments of the list. Readings are limited to their range.
//   linuxcnc  a HAL file with standard components of LinuxCNC, for axis.L.eoffset-counts
//             lincurve(9), sum2(9), mux2(9), limit2(9), conv_float_s32(9), of 2.9: counts of -K; for each sensor a
//             curve of two points, constant beyond them. The offset is cleared while the machine is off or not homed.
//
// tan beta and coefficient are 0, because a drift is measured at one position. K0 and offset0 are the error of the
// axis, as both manuals call it. The available pages do not state in which direction the axis then moves; the files
// explain how to check it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/compensation/compensation.hpp"

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

// Throws Error, with the known controls, for an unknown word, or a control whose manual has no formula of temperatures.
Control control_of(std::string_view word);

// The increment of the offset in the control: resolution_um; for Beckhoff always 0.1 um.
Increment increment_of(Control control, double resolution_um);

struct ControlLine {
  std::string axis;  // "z"
  LinearCompensation line;
  double rate_um_per_s = 0.2;         // of the offset, for LinuxCNC; the others have their own limits
  std::vector<std::string> comments;  // lines for the head
};

// The text of the file in ASCII; other characters in comments and names become ?. Throws Error for an axis of LinuxCNC
// other than x y z u v w.
std::string control_file(Control control, const ControlLine& line);

}  // namespace ballbar

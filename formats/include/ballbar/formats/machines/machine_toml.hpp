// Virtual machine `machine.toml`: what `ballbar simulate` reads. All but the format is optional; what is not
// given has the default of simulate.hpp, where each quantity and its sign is explained. The keys, with units, meanings
// and defaults, are machine_keys(), spindle_keys() and image_keys() of keys.hpp; formats/README.md has them as tables.
//
//   format = "ballbar-machine 1"
//   method = "two_arcs"            # two_arcs | spindle_rotation | circles | series
//   test_min = [0, 8, 16]
//   [bar]
//   noise_um = 0.2
//   [[truth]]
//   time_min = 16.0
//   y_um = 12.0
//
// A spindle in the place of the truth: its physics (finite_volume_spindle.hpp) moves the ball, and its sensors are
// signals, beside any [[signal]]. method = "series" has no ballbar: of the rest only title and seed may be given, and
// x_um, y_um, z_um are measured as densely as the sensors.
#pragma once

#include <string_view>

#include "ballbar/lab/simulation/simulate.hpp"

namespace ballbar {

// `name` stands in messages. Unknown keys are errors. Throws Error with name:line:column; contradictions
// between well-formed values are left to simulate().
VirtualMachine read_machine(std::string_view bytes, std::string_view name);

}  // namespace ballbar

// Virtual machine `machine.toml`, the input of `ballbar simulate`. All keys but the format are optional, with the
// defaults of simulate.hpp, which explains each quantity and its sign. The keys, with units, meanings and defaults, are
// machine_keys(), spindle_keys() and image_keys() of shaft_images.hpp; formats/README.md has them as tables.
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
// A [spindle] replaces the truth: its physics (finite_volume_spindle.hpp) moves the ball, and its sensors are signals
// in addition to any [[signal]]. method = "series" has no ballbar. It allows only title and seed as further keys, and
// measures x_um, y_um, z_um as densely as the sensors.
#pragma once

#include <string_view>
#include <vector>

#include "ballbar/formats/text/keys.hpp"
#include "ballbar/lab/simulation/simulate.hpp"

namespace ballbar {

std::vector<KeyTable> machine_keys();  // but for [spindle], [[spindle.image]] and [spindle.body]
std::vector<KeyTable> spindle_keys();  // [spindle], [spindle.measured]

// `name` is used in messages. Unknown keys are errors. Throws Error with name:line:column. simulate() checks
// for contradictions between well-formed values.
VirtualMachine read_machine(std::string_view bytes, std::string_view name);

}  // namespace ballbar

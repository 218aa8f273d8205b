// Virtual machine `machine.toml`: what `ballbar simulate` reads. All but the format is optional; what is not
// given has the default of simulate.hpp, where each quantity and its sign is explained.
//
//   format = "ballbar-machine 1"
//   method = "two_arcs"            # two_arcs | spindle_rotation | circles | series
//   title = "warm-up at 14 000 rpm"
//   seed = 1
//   started = 2015-03-02T09:00:00  # local clock at time 0; `.b5r` files need it
//   test_min = [0, 8, 16]          # default: one test at 0
//   feed_mm_per_min = 1000.0
//   plane = "XY"                   # circles: XY | YZ | ZX
//   height_offset_mm = 0.0
//   spindle_above = true           # spindle_rotation
//   [bar]        nominal_length_mm radius_error_um noise_um autocorrelation resolution_um outlier_share outlier_um
//   [setup]      x_um y_um z_um run_out_um
//   [c_arc] [a_arc]                # two_arcs: start_deg end_deg readings
//   [circle]                       # the other methods: the same, and harmonic2_um backlash_a_um for circles
//   [axial]      readings interval_s offset_um          # spindle_rotation; readings = 0: one length a test
//   [truth]      time_min = [...] x_um = [...] y_um z_um along_bar_um     # arrays of one size, or
//   [[truth]]    time_min = 0.0 x_um = 0.0 ...                            # one table a point; default: no drift
//   [signals]    interval_s = 10.0
//   [[signal]]   name role time_min = [...] value = [...] noise resolution
//   [five_probe] spacing_mm interval_s noise_um resolution_um tilt_a_urad_per_um tilt_b_urad_per_um ball_offset_mm
//
// A spindle in the place of the truth: its physics (finite_volume_spindle.hpp) moves the ball, and its sensors are
// signals, beside any [[signal]]. method = "series" has no ballbar: of the rest only title and seed may be given, and
// x_um, y_um, z_um are measured as densely as the sensors.
//
//   [spindle]
//   time_min = [0, 240]            # from these times on
//   speed_rpm = [10000, 0]         # this speed
//   load_W = [0, 0]                # and cutting power; default: none
//   end_min = 480                  # series; a session ends with its last test by default
//   room_min = [0, 480]            # straight lines between these points; default: 20 degC
//   room_degC = [20.0, 22.5]
//   off = ["centrifugal", "room"]  # mechanisms left out: viscosity convection asymmetry rings centrifugal thermostat
//                                  # coolant room structure
//   interval_s = 15.0              # of the rows
//   step_s = 15.0                  # longest step of the calculation
//   profile_min = [30, 240]        # when the temperature along the shaft is kept, up to the last row; default: never
//   [[spindle.image]]              # pictures of it: shaft_images_toml.hpp, which reads them
//   [spindle.body]                 # numbers of FiniteVolumeSpindle: f0 = 0.6, flange_mm = 180.0 ...
//   [spindle.measured]             # series: noise_um tail_freedom memory_um memory_s resolution_um; all:
//                                  # temperature_noise_K temperature_resolution_K not_logged = ["T_room_degC"]
#pragma once

#include <string_view>

#include "ballbar/simulation/simulate.hpp"

namespace ballbar {

// `name` stands in messages. Unknown keys are errors. Throws Error with name:line:column; contradictions
// between well-formed values are left to simulate().
VirtualMachine read_machine(std::string_view bytes, std::string_view name);

}  // namespace ballbar

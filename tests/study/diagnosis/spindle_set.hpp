// Data that no effect of the catalogue made: the elongation of a finite-volume spindle.
#pragma once

#include <cstdint>

#include "data_set.hpp"

namespace ballbar::study {

// One cause of the spindle beside the base model's best fit to the others; what is right: blind.hpp.
DataSet spindle_cause(std::uint64_t seed);

// z of a whole spindle of its own (numbers varied by a fifth), the record's speeds four times as fast and its room,
// temperatures to 0.1 K, noise of 0.15 um and an AR(1) noise of 0.3 um with 12 min. The base model is speed_heating.
// Turn by turn a mechanism is on that is off in the others:
//   none
//   centrifugal   right: centrifugal_shift
//   rings         right: bearing_rings, and expansions of T_front_degC and T_rear_degC
//   structure     head, column and room: expansions of T_head_degC, T_column_degC and T_room_degC, gradient_bending of
//                 two of them
// A real body is no single low pass of the speed. So also true, whatever is hidden: expansions of T_front_degC,
// T_rear_degC, T_motor_degC, T_housing_degC and T_coolant_degC, cooling_asymmetry, viscosity_feedback. Expansions are
// `expansion` and `lagged_expansion`.
DataSet whole_spindle(std::uint64_t seed);

}  // namespace ballbar::study

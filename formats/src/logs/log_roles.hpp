// Determines the role of a column from its name in several languages, and from the way its values change.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "ballbar/series/series.hpp"

namespace ballbar {

inline constexpr std::string_view kFarFromZero = "far from zero, like an axis position";

struct FoundRole {
  Role role = Role::event;
  std::string why;   // "by its name", "by its unit", "moves in steps of round numbers, as a speed"
  std::string unit;  // from the role: "rpm" for a speed without unit; else empty
};

// Of the values that are finite and not `but`; of none infinite.
struct Extremes {
  double least, most;
};
Extremes extremes_of(std::span<const double> values, double but = std::numeric_limits<double>::quiet_NaN());

// 0 and 1 alone, both of them: on and off.
bool is_switch(std::span<const double> values);

// Held at few levels, as a switch, a valve or a tool's number is and no temperature: 0 or 1 alone, or at most six
// values that come back often. Values that step by 1 at most are those of a sensor that shows whole degrees.
bool has_few_levels(std::span<const double> values);

// Whether a name is one of the room: "ambient", "Raumluft".
bool names_the_room(std::string_view name);

bool names_a_speed(std::string_view name);

inline constexpr double kWarmestRoom_degC = 45.0;  // more is in another unit

// Whether a name is one of a temperature: "T3", "temp 7", "PT100", "TC K", "frame_t".
bool says_temperature(std::string_view name);

// Whether a name is one of a part of a machine that temperatures are measured at, misspelled too.
bool names_a_part(std::string_view name);

// "X", "z": of an axis alone.
bool names_an_axis(std::string_view name);

// Whether a name is one of something else: a humidity, a pressure, a speed, a probe ...
bool names_another_quantity(std::string_view name);

// Whether a column without unit may be the measured quantity if no name shows it: "mcu_pos_z", "z_steps".
bool could_be_measured(std::string_view name);

// `unit`: canonical, may be empty. `values`: in it.
FoundRole found_role(std::string_view name, std::string_view unit, std::span<const double> values);

}  // namespace ballbar

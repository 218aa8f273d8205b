// What a spindle went through, second by second: the true course of every input, before any logger saw it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "chance.hpp"

namespace ballbar::verdicts {

using Track = std::vector<double>;  // a value a second; holds until the next

enum class Quantity { speed, load, room, coolant, housing, bearing };
inline constexpr std::size_t kQuantities = 6;
inline bool is_temperature(Quantity quantity) { return quantity >= Quantity::room; }

struct Plan {
  std::size_t span_s = 0;                 // of the record; the tracks go on for kAfter_s
  std::array<Track, kQuantities> tracks;  // rpm, W, degC
  const Track& operator[](Quantity quantity) const { return tracks[static_cast<std::size_t>(quantity)]; }
  Track& operator[](Quantity quantity) { return tracks[static_cast<std::size_t>(quantity)]; }
};
inline constexpr std::size_t kAfter_s = 900;

// Many random speeds and cuts, a room with a day's swing and doors, a coolant with two-point control. hours 0: 5 to 12.
Plan rich_plan(Chance& chance, double hours = 0.0);

// 2.5 h: a start, one change of speed and a stop, in a room that is nearly still.
Plan poor_plan(Chance& chance);

}  // namespace ballbar::verdicts

// What a spindle went through, second by second: the true course of every input, before any logger saw it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "chance.hpp"

namespace ballbar::verdicts {

using Track = std::vector<double>;  // a value a second; holds until the next

enum class Quantity { speed, load, room, coolant, housing, bearing };
inline constexpr std::size_t kQuantities = 6;
inline bool is_temperature(Quantity quantity) { return quantity >= Quantity::room; }

struct Room {
  double swing_degC = 0.0;    // half of the day's
  double door_every_s = 0.0;  // on average; 0: stays shut
  double wander_degC = 0.0;   // of a slow curve of its own
  double wander_time_s = 1800.0;
  double mean_degC = 20.0;
  double recovery_s = 600.0;  // after a door
};

// A tank with a chiller that is on or off, the housing, the front bearing.
struct Bodies {
  double set_degC = 20.0, band_degC = 0.3;  // of the chiller
  double tank_heat = 4e-4, chill = 3e-3;    // K/s
  double follows_room = 0.0;                // share of the room's change since room_degC by which the set point moves
  double room_degC = 20.0;                  // as the first record of the machine began
  double bearing_s = 300.0, housing_s = 3000.0;
  double bearing_rise = 10.0, housing_rise = 4.0, load_rise = 1.0, power = 1.3;
  double to_coolant = 0.5;
};

struct Plan {
  std::size_t before_s = 0;               // seconds of the tracks before the record begins
  std::size_t span_s = 0;                 // of the record; the tracks go on for kAfter_s
  std::array<Track, kQuantities> tracks;  // rpm, W, degC
  Room room;
  Bodies bodies;
  const Track& operator[](Quantity quantity) const { return tracks[static_cast<std::size_t>(quantity)]; }
  Track& operator[](Quantity quantity) { return tracks[static_cast<std::size_t>(quantity)]; }
};
inline constexpr std::size_t kAfter_s = 900;

// 5 to 12 h: many random speeds and cuts, a room with a day's swing and doors, a coolant with two-point control.
Plan rich_plan(Chance& chance);

// 2.5 h: a start, one change of speed and a stop, in a room that is nearly still.
Plan poor_plan(Chance& chance);

// 4 to 12 h: a rest, then one speed to the end, with cuts; room and coolant as in a rich plan.
Plan one_speed_plan(Chance& chance);

// The same machine on another day, as the schedule says: from a cold start, or behind what it did before. The room has
// the same mean and swing, at another time of day with doors and a wandering of its own. The load while it turns is the
// mean of the cuts that it had, times what the schedule says. It begins up to a reading late. A room or a coolant that
// is moved follows within minutes.
Plan plan_under(const Schedule& schedule, const Plan& first, Chance& chance);

}  // namespace ballbar::verdicts

// The menu of tests on a drift as plans of speed, room and coolant.
#pragma once

#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

constexpr double kStep_K = 3.0;      // of the room or the coolant
constexpr double kStepOfLoad = 2.0;  // times what it was

struct Stretch {
  double hours = 0.0;
  double speed_rpm = 0.0;
};

struct Plan {
  std::string name, doing;
  std::vector<Stretch> stretches;
  double room_step_h = -1.0;  // when; < 0: never
  double coolant_step_h = -1.0;
  double load_step_h = -1.0;
};

// The first column of speed that is not at rest all the time; nullptr: none.
const Column* first_speed(const Series& data);

struct Speeds {
  double full_rpm = 0.0;   // the highest that was kept for 10 min; 0: none
  double other_rpm = 0.0;  // in the middle of the widest gap between those that were; 0: none
};

Speeds speeds_of(const Series& data);

// Whether the data have a column of it.
struct Logged {
  bool room = false, coolant = false, load = false;
};
std::vector<Plan> plans_of(const Speeds& speeds, const Logged& logged);

}  // namespace ballbar

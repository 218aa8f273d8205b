// The schedule of a test: a list of dwells at constant speed.
#pragma once

#include <vector>

namespace ballbar {

// A constant speed for some time, with load, room and coolant temperature.
struct Dwell {
  double duration_s = 0.0;
  double speed_rpm = 0.0;  // 0: at rest
  double load = 1.0;       // factor on the load that the data had at this speed
  double room_K = 0.0;     // room temperature above that of the data
  double coolant_K = 0.0;  // coolant temperature above that of the data
};

struct Schedule {
  std::vector<Dwell> dwells;
  double reading_s = 60.0;   // interval between readings of the target
  bool starts_warm = false;  // true: the machine is still drifting from earlier work; false: after a night at rest
};

double duration_s(const Schedule& schedule);

// The dwell at `time_s` after the beginning; the last one after the end. The schedule needs at least one dwell.
const Dwell& dwell_at(const Schedule& schedule, double time_s);

}  // namespace ballbar

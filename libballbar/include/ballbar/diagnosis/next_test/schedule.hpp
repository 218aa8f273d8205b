// What a machine is to do in a test, stretch by stretch.
#pragma once

#include <vector>

namespace ballbar {

// A speed kept for a time, and what is set beside it.
struct Dwell {
  double duration_s = 0.0;
  double speed_rpm = 0.0;  // 0: at rest
  double load = 1.0;       // times the load that the data had at this speed
  double room_K = 0.0;     // so much warmer than the room was in the data
  double coolant_K = 0.0;  // likewise
};

struct Schedule {
  std::vector<Dwell> dwells;
  double reading_s = 60.0;   // a reading of the target every so often
  bool starts_warm = false;  // begun while the machine still moves from what it did before; else after a night at rest
};

double duration_s(const Schedule& schedule);

// The dwell at a time since the beginning; the last one after the end. At least one stretch.
const Dwell& dwell_at(const Schedule& schedule, double time_s);

}  // namespace ballbar

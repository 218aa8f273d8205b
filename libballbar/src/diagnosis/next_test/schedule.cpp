#include "ballbar/diagnosis/next_test/schedule.hpp"

namespace ballbar {

double duration_s(const Schedule& schedule) {
  double sum_s = 0.0;
  for (const Dwell& dwell : schedule.dwells) sum_s += dwell.duration_s;
  return sum_s;
}

const Dwell& dwell_at(const Schedule& schedule, double time_s) {
  double end_s = 0.0;
  for (const Dwell& dwell : schedule.dwells) {
    end_s += dwell.duration_s;
    if (time_s < end_s) return dwell;
  }
  return schedule.dwells.back();
}

}  // namespace ballbar

#include "ballbar/formats/recordings/stored_circles.hpp"

#include <limits>

#include "ballbar/units.hpp"

namespace ballbar {

std::vector<StoredCircle> stored_circles(const B5r& test) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<StoredCircle> circles;
  for (const StoredRun& run : test.run_results) {
    const auto stored = [&](const char* name) { return stored_value(test, run.parent, name, "UT_LENGTH_MM"); };
    const auto a_mm = stored("AF_CENTRE_OFFSET_A"), b_mm = stored("AF_CENTRE_OFFSET_B");
    const auto radius_mm = stored("AF_BEST_RADIUS");
    if (!a_mm || !b_mm || !radius_mm) continue;
    StoredCircle one;
    one.recording.plane = test.plane;
    one.recording.direction = run.direction.value_or(Direction::CCW);
    one.recording.nominal_length_mm = test.nominal_length_mm;
    one.recording.started_s = test.started_s;
    one.circle.model = CircleModel::polar;
    one.circle.centre_a_um = um_from_mm(*a_mm);
    one.circle.centre_b_um = um_from_mm(*b_mm);
    one.circle.radius_mm = *radius_mm;
    one.circle.covariance_um2.setConstant(kUnknown);
    one.circle.sigma_reading_um = kUnknown;
    one.circle.rms_um = kUnknown;
    one.circle.converged = true;
    circles.push_back(std::move(one));
  }
  return circles;
}

}  // namespace ballbar

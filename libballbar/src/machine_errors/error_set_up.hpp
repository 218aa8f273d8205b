// What the trace of a test says of it as a whole.
#pragma once

#include <optional>

#include "ballbar/series/series.hpp"
#include "ballbar/units.hpp"

namespace ballbar {

inline constexpr double kFullTurn_rad = 2.0 * kPi * 0.995;      // with tolerance for a missing reading
inline constexpr double kShortestArc_rad = 60.0 * kPi / 180.0;  // shorter arcs cannot separate the errors

struct ErrorSetUp {
  double arc_rad = 0.0;     // that the longest recording covers
  double middle_rad = 0.0;  // mean direction of all readings
  double length_mm = 0.0, height_mm = 0.0;
  std::optional<double> pitch_a_mm, pitch_b_mm;
};
ErrorSetUp set_up_of(const Series& trace);

// Arc that the longest recording of a trace covers.
double longest_arc_rad(const Series& trace);

// The trace with a feed for each reading. If no recording states one, delays are in um: travel in that time. Otherwise
// a recording without a feed tells nothing of what grows with it.
Series with_feed(Series trace);
bool states_feed(const Series& trace);

}  // namespace ballbar

// One ballbar recording: the bar's length along a circular path, or along one line (axial).
//
// Plane (A,B) is XY, YZ or ZX, right-handed, or one of these with its axes exchanged (YX, ZY, XZ), as some controls
// name it; the angle runs from +A towards +B whatever the hand, and so does CCW. Of the two balls one
// stays (F) and one travels (M). For a circle the length equation holds without a small-angle step:
//
//   M - F = c + R (cos theta, sin theta) + h n,      L(theta) = |M - F|
//
// c the displacement of the path's centre from the fixed ball, n the plane's normal, h the height
// difference of the balls. An axial recording has no angle: the bar is a one-dimensional gauge.
//
// Signs: a positive height_offset_mm is as described at its member. Angles are those of the program's path, not of the
// bar; at 5 um of offset on 100 mm the two differ by 50 urad. Readings may start anywhere and go round more than once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

enum class Kind { circle, axial };
enum class Motion { linear_axes, rotary_axis, spindle };  // what drives the circle
enum class Plane { XY, YZ, ZX, YX, ZY, XZ };
inline constexpr std::array kPlanes{Plane::XY, Plane::YZ, Plane::ZX, Plane::YX, Plane::ZY, Plane::XZ};
enum class MovingBall { spindle, table };
enum class Direction { CCW, CW };

struct Recording {
  Kind kind = Kind::circle;
  Motion motion = Motion::linear_axes;
  Plane plane = Plane::XY;
  MovingBall moving_ball = MovingBall::spindle;
  Direction direction = Direction::CCW;
  double nominal_length_mm = 100.0;
  double height_offset_mm = 0.0;  // h; in a spindle-rotation test positive when the spindle's ball is
                                  // nearer the table than the table's ball, so that elongation adds
  std::optional<double> feed_mm_per_min;
  std::optional<double> bar_temperature_degC;
  std::optional<double> pitch_a_mm, pitch_b_mm;  // of the ball screws of the two axes; nullopt: not known
  std::optional<double> elapsed_s;               // start of the test since the session's own zero
  std::optional<std::int64_t> started_s;         // start on the machine's local clock, s since 1970-01-01T00:00:00
  std::vector<double> time_s;                    // n readings from the start of the sweep; empty: uniform in time
  std::vector<double> angle_rad;                 // n readings; empty for axial
  std::vector<double> length_mm;                 // n readings, > 0
};

// The two axes of a plane as indices into (x, y, z): XY -> {0,1}, YZ -> {1,2}, ZX -> {2,0}, XZ -> {0,2}.
std::array<int, 2> axes_of(Plane plane);

// Arc covered by the readings, rad, in (0, 2 pi]: 2 pi minus the largest gap, plus one spacing, so that n
// readings at mid-sample of an arc give that arc. 2 pi if no gap is wider than 1.5 mean spacings. Readings may
// be in any order and may wrap. 0 for fewer than 2 readings. O(n).
double arc_rad(const Recording& recording);

// Whether both have the same number of readings at the same angles in the same order, within half a spacing.
bool same_angles(const Recording& first, const Recording& second);

std::string_view name_of(Kind kind);
std::string_view name_of(Motion motion);
std::string_view name_of(Plane plane);
std::string_view name_of(MovingBall moving_ball);
std::string_view name_of(Direction direction);

// ---- Converts ballbar recordings into one series, so that effects on recordings are fitted like effects on a drift.

// Rows: all readings of all recordings, one recording after the other, in the order of their readings. Columns, which
// effects bind by themselves:
//   deviation_um      measured length less the nominal length
//   angle_rad         theta, from +A towards +B
//   direction         +1 CCW, -1 CW
//   feed_mm_per_min   NaN where it is not stated
//   radius_mm         nominal length
//   height_mm         h of recording.hpp
//   sweep_s           time since the middle of its recording's sweep, half way from the first reading to the last
//   bar_degC          temperature of the bar, NaN where it is not stated
//   recording         0, 1, 2 ...
//   linear_axes       1 where two linear axes drive the circle, else 0
//   pitch_a_mm, _b    of the screws, NaN where they are not stated
// If a recording has no times, its n readings are at mid-sample of a sweep whose duration is nominal length times arc
// over feed; without a feed there is one reading per second. time_s starts at 0, with the sweeps end to end, 1 s apart.
// Throws Error for an axial recording, and for times that do not rise. O(n), 104 bytes per reading.
Series trace_of(std::span<const Recording> recordings);

// The column of trace_of() for the role of an input: "angle" -> "angle_rad"; empty: none.
std::string_view trace_column(std::string_view role);

}  // namespace ballbar

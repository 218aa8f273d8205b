// Finds the columns of a table that form a circle, and the runs of one direction among its readings.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "recordings/column_table.hpp"

namespace ballbar {

// Two columns of coordinates.
struct CoordinateCircle {
  std::size_t a = 0, b = 0;                             // columns
  std::optional<Plane> plane;                           // where the columns' names say so
  double centre_a = 0.0, centre_b = 0.0, radius = 0.0;  // in the columns' unit
  double off = 0.0;                                     // rms of the rows over the radius
  std::vector<std::size_t> rows;                        // on the circle, in the order of the readings
  bool sorted = false;                                  // that is the order of the angles, not of the rows
  std::optional<double> commanded_radius;               // radius of the commanded path, if present
};

// An angle beside lengths or deviations.
struct PolarCircle {
  std::size_t angle = 0;
  std::vector<std::size_t> values;  // columns; two: one a direction
  double rad_per_unit = 0.0;
  bool are_lengths = true;        // else deviations
  std::vector<std::size_t> rows;  // in the order of the readings
  bool sorted = false;            // as of CoordinateCircle
};

// Millimetres by the size of a radius without unit: below 2 it is in metres, above 2000 in um; in inches where these
// are a usual whole radius in mm and the number itself is not whole; else mm.
double likely_mm_per_unit(double radius);

// `cut_off`: of a longer file, so that the circle need not be whole, but must be named.
std::optional<CoordinateCircle> coordinate_circle(const ColumnTable& table, bool cut_off);
std::optional<PolarCircle> polar_circle(const ColumnTable& table, bool cut_off);

// The angles of `angle_rad`, each within half a turn of the one before.
std::vector<double> unwrapped(std::vector<double> angle_rad);

struct CircleRun {
  std::size_t first = 0, last = 0;  // readings, both of the run
  double travel_rad = 0.0;          // above 0: from the first axis towards the second
};

// A run ends where the angle comes back by more than 5 deg. Readings that stand still at its ends are left out, and
// runs of less than 30 deg beside ones of twice their length.
std::vector<CircleRun> runs_of(const std::vector<double>& unwrapped_rad);

}  // namespace ballbar

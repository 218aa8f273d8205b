// A plant of machines with a ballbar test a month, some with a story: which test would have been made when, with which
// errors, and the recordings of each.
//
// Errors are those of the catalogue that a ballbar test shows, a machine's own for each axis and each plane. A test
// measures of each
//
//   constant of the machine + what its story adds + scatter of the test
//
// where the scatter is Student's t, larger altogether in tests that were set up badly. Scales of all axes follow the
// temperature of the day, and their sum the length of the bar that is used. Readings have autocorrelated noise and are
// rounded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"

namespace ballbar {

enum class StoryKind {
  wear,           // errors that grow by so much a year
  crash,          // errors that step
  season,         // errors that follow the year, highest in the middle of July, by so much to either side
  replaced_part,  // errors that were there before, and go
  instrument,     // another bar
};
std::string_view name_of(StoryKind kind);

// How an error differs from machine to machine and from test to test. `name`: of its row in a table of errors, without
// the axis and, where both sides are meant, without the side: "squareness", "scale".
struct ErrorSpread {
  std::string name;
  double mean = 0.0, spread = 0.0;  // of the machines' constants, normal, in the row's unit
  double scatter = 0.0;             // from test to test
};

// Errors by name with the axis or the plane in small letters: "squareness_xy", "scale_x".
struct FleetStory {
  std::size_t machine = 1;  // from 1 on
  StoryKind kind = StoryKind::wear;
  double month = 0.0;  // from when on, since the first
  std::map<std::string, double> errors;
  std::string bar;            // instrument: the new one
  double bar_um_per_m = 0.0;  // by which it measures more than the old one
};

struct VirtualFleet {
  std::string name = "virtual fleet";  // for messages: the file it came from
  std::string title;
  std::uint64_t seed = 1;
  std::int64_t started_s = 0;  // begin of the first month
  std::size_t machines = 40, months = 36;
  std::string machine_name = "machine";  // with its number
  double missing_share = 0.06;           // of the months, in which there was no time for a test
  double days_of_month = 16.0;           // within which a test is made
  double other_planes_share = 0.3;       // of the machines, which are tested in YZ and ZX too
  std::size_t other_planes_a_year = 3;
  std::size_t bars = 4;
  double bar_spread_um_per_m = 5.0;

  double nominal_length_mm = 100.0, feed_mm_per_min = 1000.0;
  std::size_t readings = 500;
  double noise_um = 0.15, autocorrelation = 0.9, resolution_um = 0.1;
  double setup_um = 10.0;  // of the centre

  double tail_freedom = 4.0;                     // of the scatter
  double bad_share = 0.03, bad_factor = 3.0;     // tests that were set up badly
  double day_K = 1.0, hall_K = 2.0;              // temperature: of the day, and to either side of the year's mean
  double scale_um_per_m_per_K = 1.0;             // what of it the scales show
  double large_share = 0.1, large_factor = 4.0;  // machines whose constants are that much larger

  std::vector<ErrorSpread> errors;
  std::vector<FleetStory> stories;
};

struct FleetTest {
  std::size_t machine = 0;  // from 0 on
  std::string machine_name, bar;
  std::int64_t started_s = 0;
  Plane plane = Plane::XY;
  std::vector<double> errors;  // of each column of FleetCurves
  double centre_a_um = 0.0, centre_b_um = 0.0, scale_um = 0.0;
  std::uint64_t key = 0;  // of its noise
};

// What a unit of each error adds to the readings of a test: the catalogue's effects, once for all tests.
struct FleetCurves {
  struct Column {
    std::string name;          // without the axis: "squareness"
    std::optional<int> side;   // 0 or 1: of the plane's first or second axis
    std::vector<double> um;    // of the readings of both directions
    bool of_mismatch = false;  // of the scales of both axes
  };
  std::vector<Column> columns;
  std::vector<Recording> recordings;  // CCW and CW, with angles and without lengths
};

FleetCurves fleet_curves(const VirtualFleet& fleet);

// In the order of machines and dates. The same seed gives the same tests. Throws Error, naming the fleet, where a story
// is of a machine that is not there, or an error of none that a test shows.
std::vector<FleetTest> fleet_tests(const VirtualFleet& fleet, const FleetCurves& curves);

// Both directions of one test.
std::vector<Recording> recordings_of(const VirtualFleet& fleet, const FleetCurves& curves, const FleetTest& test);

}  // namespace ballbar

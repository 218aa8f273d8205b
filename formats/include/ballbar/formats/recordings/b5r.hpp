// Renishaw `.b5r`: one ballbar test with its runs and the results that the instrument's software stored.
//
// UTF-8 or UTF-16 XML, root TEST_DOCUMENT. length = NOMINAL_LENGTH + reading; readings START_INDEX to END_INDEX
// inclusive are used, the rest is overshoot; angles are not stored: uniform at mid-sample,
// CCW START + (i + 1/2) arc / N, CW END - (i + 1/2) arc / N, arc = (END - START) mod 360, 0 meaning 360.
//
// A file may hold only results, without READINGS, or only one run. A text of "-" or an empty one counts as not stated:
// it becomes an empty string or nullopt.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/formats/recordings/limits.hpp"

namespace ballbar {

// A stored value. The same NAME is in mm in a run and in um in an analysis; the key is parent + name + data_type.
struct StoredFeature {
  std::string parent;     // "run 0", "run 1", or "NAME version" of the analysis, "ISO230_4 2005"
  std::string name;       // "AF_CENTRE_OFFSET_A"
  std::string data_type;  // "UT_LENGTH_MM"
  double value = 0.0;     // in data_type's unit
  bool valid = true;      // VALID="False" in the file
  std::string status{};   // "AF_TOLERANCE_OK": judgement of the instrument's software
};

// A BALLBAR_RUN, with readings or without.
struct StoredRun {
  std::string parent;                    // of its stored values: "run 0"
  std::optional<Direction> direction;    // one without readings may lack it
  std::optional<std::size_t> recording;  // index of its recording; nullopt: no readings
};

// The simulated curve of a run from the software's own model.
struct SimulatedCurve {
  Direction direction = Direction::CCW;
  std::vector<double> deviation_um;  // length minus nominal length, one value per reading of the first such run
};

struct Calibrator {
  std::string model, serial_number, certificate;
  std::string last_calibrated;  // as of the ballbar
  std::optional<double> calibrated_length_mm;
  std::optional<double> expansion_ppm_per_K;
  std::optional<double> temperature_degC;
};

struct B5r {
  std::string test_name;  // TEST_SPEC NAME
  std::string machine;    // MACHINE_TESTED NAME
  std::string operator_name;
  std::string comment;  // several are joined by "; "
  // On the machine's own clock, s since 1970-01-01T00:00:00.
  std::optional<std::int64_t> started_s, completed_s;

  std::string ballbar_model;  // EQUIPMENT/BALLBAR/MODEL
  std::string serial_number;  // of the ballbar
  std::string certificate;
  std::string last_calibrated;         // 2024-04-16; if not a date, the text of the file
  std::optional<double> scale_factor;  // of the ballbar
  Calibrator calibrator;
  std::string software_title, software_version;

  Plane plane = Plane::XY;
  double nominal_length_mm = 100.0;
  std::optional<double> test_radius_mm;
  std::optional<double> start_deg, end_deg;  // START_ANGLE, END_ANGLE; a file with readings states both
  std::optional<double> overshoot_deg;
  std::optional<double> programmed_feed_mm_per_min;    // above 0
  std::optional<double> material_expansion_ppm_per_K;  // TEMP_MATERIAL_COEFFICIENT
  std::string spindle_number, nc_program;

  std::vector<Recording> runs;  // those with readings, in the file's order; feed_mm_per_min is the calculated one
  std::vector<StoredRun> run_results;  // all runs, in the order of the file
  std::vector<StoredFeature> stored;
  std::vector<Limit> limits;
  std::vector<SimulatedCurve> simulated_um;  // at most one a direction
  std::vector<std::string> remarks;          // whole sentences with name:line:column; after 20 no limits
                                             // and curves are read
};

// `name` is used in messages. Throws Error with name:line:column; minor faults become remarks.
B5r read_b5r(std::string_view bytes, std::string_view name);

// The stored value of that key; nullopt: absent or not valid.
std::optional<double> stored_value(const B5r& test, std::string_view parent, std::string_view name,
                                   std::string_view data_type);

// The unit of a data_type: "um", "um/m", "mm/min". An unknown type is returned unchanged.
std::string_view unit_of_data_type(std::string_view data_type);

// The parent of the stored values of a recording: "run 0".
std::string parent_of(const B5r& test, std::size_t recording);

// The curve of that direction; nullptr: none.
const SimulatedCurve* simulated_curve(const B5r& test, Direction direction);

// The bytes of a file in the instrument's layout with these runs, head, stored features, limits and curves. Angles are
// uniform at mid-sample; the overshoot is `overshoot_readings` copied from the ends. Recordings need plane, direction,
// nominal_length_mm, started_s, feed_mm_per_min, angle_rad, length_mm; these override the values of the test. Without
// recordings there must be `run_results` or stored features. Readings are in mm with five decimals, as the instrument
// writes them.
std::string write_b5r(const B5r& test, std::size_t overshoot_readings = 0);

}  // namespace ballbar

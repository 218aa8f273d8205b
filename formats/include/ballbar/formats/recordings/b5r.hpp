// Renishaw `.b5r`: one ballbar test with its runs and the results the instrument's software stored.
//
// UTF-8 XML, root TEST_DOCUMENT. length = NOMINAL_LENGTH + reading; readings START_INDEX to END_INDEX
// inclusive are used, the rest is overshoot; angles are not stored: uniform at mid-sample,
// CCW START + (i + 1/2) arc / N, CW END - (i + 1/2) arc / N, arc = (END - START) mod 360, 0 meaning 360.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"

namespace ballbar {

// The same NAME is mm in a run and um in an analysis: the key is parent + name + data_type.
struct StoredFeature {
  std::string parent;     // "run 0", "run 1", or "NAME version" of the analysis, "ISO230_4 2005"
  std::string name;       // "AF_CENTRE_OFFSET_A"
  std::string data_type;  // "UT_LENGTH_MM"
  double value = 0.0;     // in data_type's unit
  bool valid = true;      // VALID="False" in the file
};

struct B5r {
  std::string test_name;      // TEST_SPEC NAME
  std::string ballbar_model;  // EQUIPMENT/BALLBAR/MODEL
  std::string software_version;
  std::optional<double> programmed_feed_mm_per_min;
  std::vector<Recording> runs;  // in the file's order; feed_mm_per_min is the calculated one
  std::vector<StoredFeature> stored;
};

// `name` stands in messages. Throws Error with name:line:column.
B5r read_b5r(std::string_view bytes, std::string_view name);

// The stored value of that key, or nothing (absent or not valid).
std::optional<double> stored_value(const B5r& test, std::string_view parent, std::string_view name,
                                   std::string_view data_type);

// A file in the instrument's layout with these runs (uniform angles at mid-sample, no overshoot beyond
// `overshoot_readings` copied from the ends) and stored features. Recordings need plane, direction,
// nominal_length_mm, started_s, feed_mm_per_min, angle_rad, length_mm. Readings are written as the instrument does: mm,
// five decimals.
std::string write_b5r(const B5r& test, std::size_t overshoot_readings = 0);

}  // namespace ballbar

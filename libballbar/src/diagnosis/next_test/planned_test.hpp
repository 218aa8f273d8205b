// The menu of next_test.hpp: what each test would look like as data.
//
// A test drives the circles of the data again the other way round, at another feed or radius.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct PlannedTest {
  std::string name;               // "the other direction"
  std::string doing;              // "the same circles clockwise": what follows its name and a colon
  Series inputs;                  // columns of the data but the target's, from time 0
  std::vector<std::size_t> rows;  // of `inputs`, rising: where a reading is taken
  double duration_s = 0.0;
  bool new_set_up = false;  // what depends on time alone starts again; else it goes on
};

// rows: of the trace, rising, with a reading of the target; at least two.
std::vector<PlannedTest> recording_tests(const Series& trace, const std::string& target,
                                         const std::vector<std::size_t>& rows);

}  // namespace ballbar

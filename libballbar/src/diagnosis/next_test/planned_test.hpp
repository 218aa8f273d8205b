// The menu of next_test.hpp, with the data of each test.
//
// A test repeats the circles of the data in the other direction, or with another feed or radius.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct PlannedTest {
  std::string name;               // "the other direction"
  std::string doing;              // the text after the name: "the same circles clockwise"
  Series inputs;                  // columns of the data without the target, from time 0
  std::vector<std::size_t> rows;  // rising indices of rows of `inputs` with a reading
  double duration_s = 0.0;
  bool new_set_up = false;  // effects of time alone start again; false: they continue
};

// rows: rising indices of rows of the trace with a reading of the target; at least two.
std::vector<PlannedTest> recording_tests(const Series& trace, const std::string& target,
                                         const std::vector<std::size_t>& rows);

}  // namespace ballbar

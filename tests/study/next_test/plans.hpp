// Plans that ask nothing of the data but their speeds: what a designed test is compared with.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar::next_test {

// Begins with some minutes at rest; then speeds of up to the highest, a quarter of them rest, each kept for 10 to 60
// min. The same seed gives the same staircase, of more hours a longer one.
Schedule staircase(double hours, double max_rpm, std::uint64_t seed);

struct FixedPlan {
  std::string name;
  Schedule schedule;
};

// Ten tests of a shop at the highest speed of the data (or max_rpm, where they have none) and in the middle of the
// widest gap between their speeds: 10 min at rest, then over and over until the hours are full. 0 hours: once.
std::vector<FixedPlan> fixed_plans(const Series& data, double hours, double max_rpm);

}  // namespace ballbar::next_test

// Every quantity of every machine over time, whatever the bar.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/history/machine_test.hpp"
#include "ballbar/history/test_groups.hpp"

namespace ballbar {

// One quantity of one group of a machine's tests. Tests of a day with one bar are one value, their mean. Values with an
// infinite sigma and without a date are left out.
struct QuantitySeries {
  std::size_t machine = 0;  // place in AllSeries::machines
  std::size_t group = 0;    // place in the groups of that machine
  std::size_t family = 0;   // same name and plane: same number
  std::string_view name, unit;
  Plane plane = Plane::XY;
  double radius_mm = 0.0;
  std::vector<std::size_t> tests;    // the last of each day
  std::vector<double> time_s;        // rising
  std::vector<double> value, sigma;  // sigma NaN: not known
  std::vector<std::string_view> bar;
  bool significant = true;  // the error of the last value is
};

struct MachineTests {
  std::string name;
  std::vector<std::size_t> tests;
  std::vector<TestGroup> groups;
};

struct AllSeries {
  std::vector<MachineTests> machines;  // by name
  std::vector<QuantitySeries> series;  // of one machine after the other; those of set-up left out
  std::size_t families = 0;
  std::vector<std::string> without_date;  // files
};

// O(n log n).
AllSeries all_series(std::span<const MachineTest> tests);

}  // namespace ballbar

// Every quantity of every machine over time, from tests with different bars alike.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/history/machine_test.hpp"

namespace ballbar {

// What one machine's tests say of one quantity: those of one plane, length, arc and feed, whatever the bar. Tests of a
// day with one bar are one value, their mean. Values with an infinite sigma and without a date are left out.
struct QuantitySeries {
  std::size_t machine = 0;  // place among the names
  std::size_t family = 0;   // same name and plane: same number
  std::string_view name, unit;
  Plane plane = Plane::XY;
  double radius_mm = 0.0;
  std::vector<std::size_t> tests;    // the last of each day
  std::vector<double> time_s;        // rising
  std::vector<double> value, sigma;  // sigma NaN: not known
  std::vector<std::string_view> bar;
};

struct AllSeries {
  std::vector<std::string> machines;            // by name
  std::vector<std::vector<std::size_t>> tests;  // of each machine
  std::vector<QuantitySeries> series;           // of one machine after the other; those of set-up left out
  std::size_t families = 0;
  std::size_t without_date = 0;
};

// O(n log n).
AllSeries all_series(std::span<const MachineTest> tests);

}  // namespace ballbar

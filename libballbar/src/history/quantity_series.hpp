// Every quantity of every machine over time, whatever the bar.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/history/machine_test.hpp"

namespace ballbar {

inline constexpr std::size_t kTestsOfTrend = 3;        // fewer tell no trend
inline constexpr double kSpanOfTrend_s = 7 * 86400.0;  // tests of one week tell none that a year has

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

// What a quantity of a test is of: which axis, which effect, or all axes together.

struct QuantityKind {
  const Effect* effect = nullptr;  // of the catalogue, whose row it is; of a scale that of two scales
  std::optional<int> axis;         // 0, 1, 2 of X, Y, Z
  std::string stem;                // what it is without axis and side: the same for both sides and all axes
  bool of_scale = false;           // of one axis, or of all
  bool of_sum = false;             // circularity, what the fit leaves: they follow the others
  bool of_both_scales = false;     // how the scales of both axes differ
};

QuantityKind kind_of(std::string_view name, Plane plane);

}  // namespace ballbar

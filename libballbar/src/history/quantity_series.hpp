// Every quantity of every machine over time, with any bar.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/history/history.hpp"

namespace ballbar {

inline constexpr std::size_t kTestsOfTrend = 3;        // smallest number for a trend
inline constexpr double kSpanOfTrend_s = 7 * 86400.0;  // shortest time for a trend

// One quantity of one group of a machine's tests. Tests of a day with one bar are one value, their mean. Values with an
// infinite sigma and without a date are left out.
struct QuantitySeries {
  std::size_t machine = 0;  // index into AllSeries::machines
  std::size_t group = 0;    // index into the groups of that machine
  std::size_t family = 0;   // equal for the same name and plane
  std::string_view name, unit;
  Plane plane = Plane::XY;
  double radius_mm = 0.0;
  std::vector<std::size_t> tests;    // the last of each day
  std::vector<double> time_s;        // rising
  std::vector<double> value, sigma;  // sigma NaN: not known
  std::vector<std::string_view> bar;
  bool significant = true;  // of the error of the last value
};

struct MachineTests {
  std::string name;
  std::vector<std::size_t> tests;
  std::vector<TestGroup> groups;
};

struct AllSeries {
  std::vector<MachineTests> machines;  // by name
  std::vector<QuantitySeries> series;  // machine by machine, without set-up
  std::size_t families = 0;
  std::vector<std::string> without_date;  // files
};

// O(n log n).
AllSeries all_series(std::span<const MachineTest> tests);

// The subject of a quantity: an axis, an effect, or all axes together.

struct QuantityKind {
  const Effect* effect = nullptr;  // the effect of the row; for a scale that of the mismatch of two scales
  std::optional<int> axis;         // 0, 1, 2 of X, Y, Z
  std::string stem;                // the name without axis and side
  bool of_scale = false;           // a scale of one axis or of all
  bool of_sum = false;             // circularity or residual, which follow from the others
  bool of_both_scales = false;     // the difference of the scales of both axes
};

QuantityKind kind_of(std::string_view name, Plane plane);

}  // namespace ballbar

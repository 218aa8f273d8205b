#include "ballbar/history/test_groups.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

namespace ballbar {
namespace {

using Places = std::vector<std::size_t>;

constexpr double kLengthGap_mm = 0.1;
constexpr double kArcGap_deg = 2.0;
constexpr double kFeedGap = 0.05;
constexpr double kFullCircle_deg = 359.0;

// Parts of the places between which the number leaps, rising; `gap`: whether one number and the next do.
std::vector<Places> parted(Places places, const std::function<double(std::size_t)>& number,
                           const std::function<bool(double, double)>& gap) {
  std::stable_sort(places.begin(), places.end(),
                   [&](std::size_t left, std::size_t right) { return number(left) < number(right); });
  std::vector<Places> parts;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i == 0 || gap(number(places[i - 1]), number(places[i]))) parts.emplace_back();
    parts.back().push_back(places[i]);
  }
  return parts;
}

std::vector<Places> parted(const std::vector<Places>& wholes, const std::function<double(std::size_t)>& number,
                           const std::function<bool(double, double)>& gap) {
  std::vector<Places> all;
  for (const Places& whole : wholes) {
    for (Places& part : parted(whole, number, gap)) all.push_back(std::move(part));
  }
  return all;
}

bool is_full(const MachineTest& test) { return test.arc_deg >= kFullCircle_deg; }

TestGroup group_of(std::span<const MachineTest> tests, Places places) {
  std::sort(places.begin(), places.end());
  const auto when = [&](std::size_t i) { return std::tie(tests[i].started_s, tests[i].file); };
  std::stable_sort(places.begin(), places.end(),
                   [&](std::size_t left, std::size_t right) { return when(left) < when(right); });
  const MachineTest& last = tests[places.back()];
  TestGroup group;
  group.plane = last.plane;
  group.nominal_length_mm = last.nominal_length_mm;
  group.start_deg = last.start_deg;
  group.arc_deg = is_full(last) ? 360.0 : last.arc_deg;
  group.feed_mm_per_min = last.feed_mm_per_min;
  group.tests = std::move(places);
  return group;
}

}  // namespace

std::vector<TestGroup> groups_of(std::span<const MachineTest> tests, std::vector<std::size_t> places) {
  std::vector<Places> parts = parted(
      std::move(places), [&](std::size_t i) { return static_cast<double>(tests[i].plane); },
      [](double left, double right) { return left != right; });
  const auto by = [](double gap) { return [gap](double left, double right) { return right - left > gap; }; };
  parts = parted(
      parts, [&](std::size_t i) { return tests[i].nominal_length_mm; }, by(kLengthGap_mm));
  parts = parted(
      parts, [&](std::size_t i) { return is_full(tests[i]) ? 360.0 : tests[i].arc_deg; }, by(kArcGap_deg));
  // An arc that starts at 359.9 deg is one that starts at 0.
  const auto start = [&](std::size_t i) {
    return is_full(tests[i])                           ? 0.0
           : tests[i].start_deg >= 360.0 - kArcGap_deg ? tests[i].start_deg - 360.0
                                                       : tests[i].start_deg;
  };
  parts = parted(parts, start, by(kArcGap_deg));
  parts = parted(
      parts, [&](std::size_t i) { return tests[i].feed_mm_per_min.value_or(0.0); },
      [](double left, double right) { return right > (1.0 + kFeedGap) * left; });
  std::vector<TestGroup> groups;
  groups.reserve(parts.size());
  for (Places& part : parts) groups.push_back(group_of(tests, std::move(part)));
  return groups;
}

}  // namespace ballbar

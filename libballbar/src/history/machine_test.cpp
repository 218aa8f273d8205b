#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include "ballbar/history/history.hpp"
#include "ballbar/units.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

// Of the sweep, in whatever direction it went: half a reading's spacing before its first angle.
double start_deg_of(const Recording& recording, double arc_deg) {
  const bool ccw = recording.direction == Direction::CCW;
  const double first_deg = deg_from_rad(ccw ? recording.angle_rad.front() : recording.angle_rad.back());
  const double start = first_deg - 0.5 * arc_deg / static_cast<double>(recording.angle_rad.size());
  return start - 360.0 * std::floor(start / 360.0);
}

double duration_s(std::span<const Recording> recordings) {
  double total_s = 0.0;
  for (const Recording& one : recordings) {
    if (one.time_s.size() > 1) {
      total_s += one.time_s.back() - one.time_s.front();
    } else if (one.feed_mm_per_min) {
      total_s += 60.0 * arc_rad(one) * one.nominal_length_mm / *one.feed_mm_per_min;
    }
  }
  return total_s;
}

// Variances from n readings are as certain as from 1 / (1/n + share^2 theta / T) independent ones: sum of the squares
// of the noise's autocorrelation.
double sigma_of_rms(const MachineErrors& errors, std::span<const Recording> recordings) {
  double readings = 0.0;
  for (const Recording& one : recordings) readings += static_cast<double>(one.length_mm.size());
  const Noise& noise = errors.noise;
  const double white2 = noise.white_um * noise.white_um;
  const double memory2 = noise.correlated_um * noise.correlated_um;
  const double share = white2 + memory2 > 0.0 ? memory2 / (white2 + memory2) : 0.0;
  const double total_s = duration_s(recordings);
  const double theta_s = total_s > 0.0 ? noise.correlation_time_s / total_s : 0.0;
  return errors.residual_rms_um * std::sqrt(0.5 * (1.0 / readings + share * share * theta_s));
}

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

bool within(const Tolerance& tolerance, double value) {
  return !(tolerance.lower && value < *tolerance.lower) && !(tolerance.upper && value > *tolerance.upper);
}

std::string scale_name(int axis) { return std::string("scale_") + "xyz"[axis]; }

MachineTest test_head(std::span<const Recording> recordings) {
  const Recording& first = recordings.front();
  MachineTest test;
  test.plane = first.plane;
  test.nominal_length_mm = first.nominal_length_mm;
  test.arc_deg = deg_from_rad(arc_rad(first));
  test.start_deg = start_deg_of(first, test.arc_deg);
  double feeds = 0.0;
  for (const Recording& one : recordings) {
    if (one.started_s) test.started_s = std::min(*one.started_s, test.started_s.value_or(*one.started_s));
    if (std::find(test.directions.begin(), test.directions.end(), one.direction) == test.directions.end()) {
      test.directions.push_back(one.direction);
    }
    feeds += one.feed_mm_per_min.value_or(kUnknown);
  }
  if (std::isfinite(feeds)) test.feed_mm_per_min = feeds / static_cast<double>(recordings.size());
  return test;
}

MachineTest machine_test(const MachineErrors& errors, std::span<const Recording> recordings) {
  MachineTest test = test_head(recordings);
  test.quantities.reserve(errors.errors.size() + errors.groups.size() + 4);
  for (const MachineError& row : errors.errors) {
    // Without a feed a delay is in um: another quantity than that of other tests.
    const auto has_unit = [&](const Parameter& gain) { return gain.unit == row.unit; };
    const bool is_comparable =
        row.effect == nullptr || std::any_of(row.effect->parameters.begin(), row.effect->parameters.end(), has_unit);
    const bool of_set_up = !is_comparable || (row.effect == nullptr && row.name.starts_with("centre_"));
    test.quantities.push_back({row.name, row.unit, row.value, row.sigma, of_set_up});
  }
  for (const RankedError& ranked : errors.ranked) {
    for (const std::size_t row : ranked.rows) {
      test.quantities[row].significant = ranked.significant;
      test.quantities[row].rank = ranked.rank;
    }
  }
  for (const ErrorGroup& group : errors.groups) {
    test.quantities.push_back(
        {name_of(group), "um", group.individual_circularity_um, group.sigma_um, false, true, group.rank});
  }
  test.quantities.push_back({"circularity", "um", errors.circularity_um,
                             std::sqrt(2.0) * std::hypot(errors.noise.white_um, errors.noise.correlated_um)});
  test.quantities.push_back({"residual_rms", "um", errors.residual_rms_um, sigma_of_rms(errors, recordings)});
  test.scales = axis_scales(errors, test.nominal_length_mm);
  if (test.scales) {
    const auto [a, b] = axes_of(test.plane);
    const Eigen::Vector2d sigma = test.scales->covariance.diagonal().cwiseSqrt();
    test.quantities.push_back({scale_name(a), "um/m", test.scales->a_ppm, sigma[0]});
    test.quantities.push_back({scale_name(b), "um/m", test.scales->b_ppm, sigma[1]});
  }
  test.squareness = squareness_of(errors);
  return test;
}

std::string_view name_of(TestCondition condition) {
  constexpr std::array<std::string_view, 7> kNames{"nominal_length", "arc",   "feed", "directions", "bar",
                                                   "machine",        "stored"};
  return kNames[static_cast<std::size_t>(condition)];
}

std::vector<TestCondition> differing_conditions(const MachineTest& one, const MachineTest& other) {
  std::vector<TestCondition> differing;
  const auto add = [&](TestCondition condition, bool differs) {
    if (differs) differing.push_back(condition);
  };
  const auto both_directions = [](const MachineTest& test) {
    std::vector<Direction> directions = test.directions;
    std::sort(directions.begin(), directions.end());
    return directions;
  };
  const auto differ = [](const std::string& left, const std::string& right) {
    return !left.empty() && !right.empty() && left != right;
  };
  const double turned_deg = std::abs(std::remainder(one.start_deg - other.start_deg, 360.0));
  const bool both_full = is_full(one) && is_full(other);
  add(TestCondition::nominal_length, std::abs(one.nominal_length_mm - other.nominal_length_mm) > kLengthGap_mm);
  add(TestCondition::arc,
      !both_full && (std::abs(one.arc_deg - other.arc_deg) > kArcGap_deg || turned_deg > kArcGap_deg));
  if (one.feed_mm_per_min && other.feed_mm_per_min) {
    const auto [slow, fast] = std::minmax(*one.feed_mm_per_min, *other.feed_mm_per_min);
    add(TestCondition::feed, fast > (1.0 + kFeedGap) * slow);
  }
  add(TestCondition::directions,
      !one.directions.empty() && !other.directions.empty() && both_directions(one) != both_directions(other));
  add(TestCondition::bar, differ(one.bar, other.bar));
  add(TestCondition::machine, differ(one.machine, other.machine));
  add(TestCondition::stored, one.stored != other.stored);
  return differing;
}

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

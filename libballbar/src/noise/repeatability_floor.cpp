#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ballbar/internal/series/speed_steps.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/noise/noise.hpp"
#include "ballbar/units.hpp"
#include "noise/linear_filter.hpp"
#include "numerics/interpolation.hpp"
#include "series/standstill.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestOfRepeat = 8, kFewestOfStandstill = 20;
// Fewer residuals count as white; their innovations equal the residual, which would then be its own floor.
constexpr std::size_t kFewestOfResidual = 30;
constexpr double kShortestStandstill_s = 600.0;
constexpr double kSettled_s = 7200.0;
constexpr double kSameSpeed = 0.02;   // of the largest
constexpr double kSameLength = 0.1;   // of the longer
constexpr double kPassedOver = 1.25;  // times the residual's noise

struct Stretch {
  double before_rpm = 0.0, speed_rpm = 0.0;
  std::span<const double> time_s, target_um;
  double length_s() const { return time_s.back() - time_s.front(); }
};

struct Repeats {
  double squares = 0.0, variances = 0.0;  // of the differences; expected of them for a target of variance 1
  std::size_t pairs = 0;
};

// Sum of squares about a straight line: a slow drift is no noise.
double squares_about_line(std::span<const double> time_s, std::span<const double> values_um) {
  const auto n = static_cast<double>(time_s.size());
  double time = 0.0, value = 0.0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    time += time_s[i] / n;
    value += values_um[i] / n;
  }
  double tt = 0.0, tv = 0.0, vv = 0.0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double t = time_s[i] - time, v = values_um[i] - value;
    tt += t * t;
    tv += t * v;
    vv += v * v;
  }
  return std::max(0.0, vv - tv * tv / tt);
}

// Degrees of freedom about a line of so many values.
double degrees_about_line(std::size_t count) { return static_cast<double>(count) - 2.0; }

// Difference of `b` to `a` at a's times since the start, about a line. A value between two rows of b at `share` of
// the way scatters less than one: (1 - share)^2 + share^2.
void compare(const Stretch& a, const Stretch& b, Repeats& repeats) {
  std::vector<double> differences;
  differences.reserve(a.time_s.size());
  double expected = 0.0;
  const auto since_s = [&](std::size_t row) { return b.time_s[row] - b.time_s.front(); };
  std::size_t row = 0;  // of b, the last one before
  for (std::size_t i = 0; i < a.time_s.size(); ++i) {
    const double at_s = a.time_s[i] - a.time_s.front();
    if (at_s > b.length_s()) break;
    while (row + 1 < b.time_s.size() && since_s(row + 1) <= at_s) ++row;
    const double from_s = since_s(row);
    const Place place{row, from_s == at_s ? 0.0 : (at_s - from_s) / (since_s(row + 1) - from_s)};
    differences.push_back(a.target_um[i] - value_at(b.target_um, place));
    expected += 1.0 + (1.0 - place.share) * (1.0 - place.share) + place.share * place.share;
  }
  const std::size_t n = differences.size();
  if (n < kFewestOfRepeat) return;
  repeats.squares += squares_about_line(a.time_s.first(n), differences);
  repeats.variances += expected * degrees_about_line(n) / static_cast<double>(n);
  ++repeats.pairs;
}

std::optional<Floor> of_repeats(const std::vector<Stretch>& stretches, double largest_rpm) {
  const auto same = [&](double a, double b) { return std::abs(a - b) <= kSameSpeed * largest_rpm; };
  Repeats repeats;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    for (std::size_t j = i + 1; j < stretches.size(); ++j) {
      const Stretch &a = stretches[i], &b = stretches[j];
      const double longer_s = std::max(a.length_s(), b.length_s());
      if (!same(a.speed_rpm, b.speed_rpm) || !same(a.before_rpm, b.before_rpm)) continue;
      if (std::abs(a.length_s() - b.length_s()) > kSameLength * longer_s) continue;
      compare(a, b, repeats);
    }
  }
  if (repeats.pairs == 0) return std::nullopt;
  return Floor{std::sqrt(repeats.squares / repeats.variances),
               repeats.pairs == 1 ? messages::noise_of_a_repeat() : messages::noise_of_repeats(repeats.pairs)};
}

std::optional<Floor> of_standstill(const std::vector<SpeedStep>& steps, double largest_rpm,
                                   std::span<const double> time_s, std::span<const double> target_um) {
  std::size_t begin = 0, end = 0;
  for (const SpeedStep& step : steps) {
    if (!at_standstill(step.speed_rpm, largest_rpm)) continue;
    std::size_t first = step.begin;
    while (first < step.end && time_s[first] < time_s[step.begin] + kSettled_s) ++first;
    if (step.end - first < kFewestOfStandstill || time_s[step.end - 1] - time_s[first] < kShortestStandstill_s)
      continue;
    if (end == 0 || time_s[step.end - 1] - time_s[first] > time_s[end - 1] - time_s[begin]) {
      begin = first;
      end = step.end;
    }
  }
  if (end == 0) return std::nullopt;
  return Floor{std::sqrt(squares_about_line(time_s.subspan(begin, end - begin), target_um.subspan(begin, end - begin)) /
                         degrees_about_line(end - begin)),
               messages::noise_of_standstill(fmt::format("{:.0f}", min_from_s(time_s[begin])),
                                             fmt::format("{:.0f}", min_from_s(time_s[end - 1])))};
}

std::optional<Floor> of_innovations(const Noise& noise, std::span<const double> time_s,
                                    std::span<const double> sigma_um) {
  if (time_s.size() < kFewestOfResidual) return std::nullopt;
  double variances = 0.0;
  const LinearFilter filter(time_s, {.variance = squares_of(sigma_um)});
  filter.for_each_gain(variances_of(noise), [&](const FilterGain& of, Eigen::Index rows) {
    variances += static_cast<double>(rows) / of.weight;
  });
  return Floor{std::sqrt(variances / static_cast<double>(time_s.size())), messages::noise_of_prediction()};
}

}  // namespace

Floor floor_of(std::span<const double> time_s, std::span<const double> target_um, std::span<const double> sigma_um,
               std::span<const double> speed_rpm, const Noise& residual_noise) {
  if (time_s.empty()) return {};
  double stated_um2 = 0.0;
  for (const double sigma : sigma_um) stated_um2 += sigma * sigma / static_cast<double>(sigma_um.size());
  const double all_um = std::sqrt(residual_noise.white_um * residual_noise.white_um +
                                  residual_noise.correlated_um * residual_noise.correlated_um + stated_um2);
  const auto plausible = [&](const std::optional<Floor>& floor) {
    return floor && floor->rms_um <= kPassedOver * all_um;
  };

  std::optional<Floor> floor;
  if (!speed_rpm.empty()) {
    const Column speed{"speed_rpm", Role::speed, {speed_rpm.begin(), speed_rpm.end()}};
    const std::vector<SpeedStep> steps = speed_steps({time_s.begin(), time_s.end()}, speed);
    const double largest_rpm = largest_of(speed.values);
    std::vector<Stretch> stretches;  // the first one starts from what nobody knows, the last one ends in nothing
    for (std::size_t i = 1; i < steps.size(); ++i) {
      const std::size_t n = steps[i].end - steps[i].begin;
      if (n < kFewestOfRepeat) continue;
      stretches.push_back({steps[i - 1].speed_rpm, steps[i].speed_rpm, time_s.subspan(steps[i].begin, n),
                           target_um.subspan(steps[i].begin, n)});
    }
    floor = of_repeats(stretches, largest_rpm);
    if (!plausible(floor)) floor = of_standstill(steps, largest_rpm, time_s, target_um);
    if (!plausible(floor)) floor = std::nullopt;
  }
  if (!floor) floor = of_innovations(residual_noise, time_s, sigma_um);
  const double stated_um = std::sqrt(stated_um2);
  if (stated_um > 0.0 && (!floor || floor->rms_um <= stated_um)) return {stated_um, messages::noise_of_circles()};
  return floor.value_or(Floor{});
}

}  // namespace ballbar

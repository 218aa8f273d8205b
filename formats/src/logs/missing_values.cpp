#include "logs/missing_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/series/signal_kind.hpp"
#include "logs/log_roles.hpp"
#include "logs/log_table.hpp"

namespace ballbar {
namespace {

constexpr double kNoReading = 9e36;  // 9.9E37 and 1E38 stand for overload

// Numbers that loggers write where there is no value; only where they stand far outside all others.
constexpr double kSentinels[] = {-999.0,  -9999.0, -99999.0, -999.9,   -999.99, -9999.9, -99.9,
                                 -99.99,  -273.15, 999.9,    9999.0,   9999.9,  99999.0, 32767.0,
                                 65535.0, 3276.7,  6553.5,   -32768.0, -1e6,    1e6,     -3276.8};

constexpr double kLeastPossible_degC = -60.0, kMostPossible_degC = 400.0, kWarmestOfOthers_degC = 200.0;
constexpr std::size_t kWindow = 7, kFewestValues = 20;
constexpr std::size_t kFewOutliers = 4;
constexpr double kOneHeight = 2.0;          // ratio of the largest to the smallest
constexpr std::size_t kFewestBetween = 20;  // values on the average between two single ones
constexpr double kFarNoise = 20.0, kFarShare = 0.5, kNoiseOfMad = 1.4826;

double share_of(const std::vector<double>& values, double share) {
  return order_statistic(values, static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

// Of the changes, or the least change where most are none: the resolution.
double usual_change(const std::vector<double>& values) {
  std::vector<double> changes, sizes;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i) {
    changes.push_back(values[i] - values[i - 1]);
    if (changes.back() != 0.0) least = std::min(least, std::abs(changes.back()));
  }
  const double middle = median(changes);
  for (const double change : changes) sizes.push_back(std::abs(change - middle));
  return std::max(kNoiseOfMad * median(std::move(sizes)), std::isfinite(least) ? least : 0.0);
}

}  // namespace

std::string take_failed_temperatures(std::vector<double>& values, double factor, double offset) {
  const auto fails = [&](double value) {
    const double t_degC = factor * value + offset;
    return t_degC < kLeastPossible_degC || t_degC > kMostPossible_degC;
  };
  std::size_t count = 0, known = 0;
  double example = 0.0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    ++known;
    if (fails(value)) {
      ++count;
      example = value;
    } else if (factor * value + offset > kWarmestOfOthers_degC) {
      return {};  // an oven
    }
  }
  if (count == 0 || 2 * count >= known) return {};
  for (double& value : values) {
    if (std::isfinite(value) && fails(value)) value = kGap;
  }
  return fmt::format("{} times {:g}{}", count, example, count == 1 ? "" : " and the like");
}

std::string take_repeated_numbers(std::vector<double>& values) {
  constexpr std::size_t kFewest = 3;
  const Extremes all = extremes_of(values);
  for (const double number : {all.least, all.most}) {
    std::vector<double> rest;
    std::size_t count = 0;
    bool is_in_run = false;
    double jump = 0.0;  // largest change across a run of the number
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      if (value == number) {
        ++count;
        is_in_run = true;
        continue;
      }
      if (is_in_run && !rest.empty()) jump = std::max(jump, std::abs(value - rest.back()));
      is_in_run = false;
      rest.push_back(value);
    }
    if (count < kFewest || 5 * count > rest.size() + count || rest.size() < kFewestValues) continue;
    const Extremes others = extremes_of(rest);
    const double range = others.most - others.least;
    if (!(range > 0.0)) continue;  // on and off
    const double apart = number < others.least ? others.least - number : number - others.most;
    if (!(apart > std::max(range, kFarNoise * usual_change(rest))) || !(jump < 0.5 * apart)) continue;
    if (signal_kind(rest) == SignalKind::steps) continue;
    std::replace(values.begin(), values.end(), number, kGap);
    return fmt::format("{} times {:g}", count, number);
  }
  return {};
}

std::string take_single_outliers(std::vector<double>& values) {
  std::vector<double> known;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!std::isfinite(values[row])) continue;
    known.push_back(values[row]);
    rows.push_back(row);
  }
  if (known.size() < kFewestValues) return {};
  const double low = share_of(known, 0.05), high = share_of(known, 0.95);
  const double far = std::max(kFarNoise * usual_change(known), kFarShare * (high - low));
  std::vector<std::size_t> found;
  for (std::size_t i = kWindow / 2; i + kWindow / 2 < known.size(); ++i) {
    if (known[i] >= low && known[i] <= high) continue;
    const auto begin = known.begin() + static_cast<std::ptrdiff_t>(i - kWindow / 2);
    const double middle = median(std::vector<double>(begin, begin + kWindow));
    const auto is_off = [&](std::size_t k) { return std::abs(known[k] - middle) > far; };
    if (is_off(i) && !is_off(i - 1) && !is_off(i + 1)) found.push_back(i);
  }
  if (found.empty() || found.size() > 2 + known.size() / kFewestBetween) return {};
  if (found.size() > kFewOutliers) {  // many of one height are events of the machine
    std::vector<double> heights;
    heights.reserve(found.size());
    for (const std::size_t i : found) heights.push_back(known[i] - 0.5 * (known[i - 1] + known[i + 1]));
    const auto [least, most] = std::minmax_element(heights.begin(), heights.end());
    if (*least * *most > 0.0 && std::max(*least / *most, *most / *least) < kOneHeight) return {};
  }
  std::vector<double> rest = known;  // a single value far off looks like steps itself
  for (const std::size_t i : found) rest[i] = kGap;
  if (signal_kind(rest) == SignalKind::steps) return {};
  for (const std::size_t i : found) values[rows[i]] = kGap;
  const std::size_t first = found.front();
  return fmt::format("{} single {} far off, such as {:g} between {:g} and {:g}", found.size(),
                     found.size() == 1 ? "value" : "values", known[first], known[first - 1], known[first + 1]);
}

std::string take_missing_values(std::vector<double>& values) {
  std::string found;
  const auto take_out = [&](auto is_none) {
    std::size_t count = 0;
    double example = 0.0;
    for (double& value : values) {
      if (!is_none(value)) continue;
      example = value;
      value = kGap;
      ++count;
    }
    if (count > 0) found += fmt::format("{}{} times {:g}", found.empty() ? "" : ", ", count, example);
  };
  for (int side = 0; side < 4; ++side) {
    const Extremes all = extremes_of(values);
    if (std::abs(all.least) >= kNoReading || std::abs(all.most) >= kNoReading) {
      take_out([](double v) { return std::abs(v) >= kNoReading; });
      continue;
    }
    const auto is_known = [](double v) {
      return std::find(std::begin(kSentinels), std::end(kSentinels), v) != std::end(kSentinels);
    };
    const bool low = is_known(all.least), high = is_known(all.most);
    if (!low && !high) break;
    bool any = false;
    for (const double one : {low ? all.least : kGap, high ? all.most : kGap}) {
      if (std::isnan(one)) continue;
      const Extremes rest = extremes_of(values, one);
      const double far = 3.0 * (rest.most - rest.least) + 50.0;
      if (!(one < rest.least - far || one > rest.most + far)) continue;
      take_out([&](double v) { return v == one; });
      any = true;
    }
    if (!any) break;
  }
  return found;
}

}  // namespace ballbar

#include "ballbar/internal/series/signal_kind.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ballbar {
namespace {

constexpr double kSameSize = 1e-9;  // of the range: the rounding of a double that counts seconds since 1970
constexpr std::size_t kMostSizes = 2;
constexpr std::size_t kFewestRises = 3, kFewestRisesHeld = 10;
constexpr double kLarge = 0.03;       // of the range: the noise of a sensor is less
constexpr double kLargeShare = 0.15;  // of the changes: a ramp between two levels may take some rows

// Whether the runs between rises are about equally long; the record may begin and end within one.
bool rises_evenly(const std::vector<double>& changes) {
  std::size_t rises = 0, run = 0, longest = 0, shortest = changes.size();
  for (const double change : changes) {
    ++run;
    if (!(change > 0.0)) continue;
    if (++rises > 1) {
      longest = std::max(longest, run);
      shortest = std::min(shortest, run);
    }
    run = 0;
  }
  return rises >= kFewestRisesHeld && longest <= 2 * shortest + 1;
}

bool is_counter(const std::vector<double>& changes, double range) {
  std::vector<double> sizes;
  std::size_t rises = 0;
  for (const double change : changes) {
    if (change < 0.0) return false;
    rises += change > 0.0;
    const bool known = std::any_of(sizes.begin(), sizes.end(),
                                   [&](double size) { return std::abs(size - change) <= kSameSize * range; });
    if (known) continue;
    if (sizes.size() == kMostSizes) return false;
    sizes.push_back(change);
  }
  if (rises < kFewestRises) return false;
  return rises == changes.size() || rises_evenly(changes);
}

// On and off.
bool is_of_two(const std::vector<double>& changes, double range) {
  return std::all_of(changes.begin(), changes.end(),
                     [&](double change) { return change == 0.0 || std::abs(change) == range; });
}

bool is_stepwise(const std::vector<double>& changes, double range) {
  std::size_t large = 0;
  double by_large = 0.0, all = 0.0;
  for (const double change : changes) {
    const double size = std::abs(change);
    all += size;
    if (!(size > kLarge * range)) continue;
    ++large;
    by_large += size;
  }
  return static_cast<double>(large) < kLargeShare * static_cast<double>(changes.size()) && by_large > 0.5 * all;
}

}  // namespace

SignalKind signal_kind(std::span<const double> values) {
  std::vector<double> changes;
  double least = 0.0, most = 0.0, last = NAN;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    if (std::isnan(last)) {
      least = most = value;
    } else {
      changes.push_back(value - last);
      least = std::min(least, value);
      most = std::max(most, value);
    }
    last = value;
  }
  const double range = most - least;
  if (!(range > 0.0)) return SignalKind::still;
  if (is_counter(changes, range)) return SignalKind::counter;
  return is_of_two(changes, range) || is_stepwise(changes, range) ? SignalKind::steps : SignalKind::smooth;
}

bool may_drive(std::span<const double> values) {
  const SignalKind kind = signal_kind(values);
  return kind == SignalKind::steps || kind == SignalKind::smooth;
}

}  // namespace ballbar

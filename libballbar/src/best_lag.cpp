#include "best_lag.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "interpolation.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostSamples = 2000;
constexpr int kStepsEachWay = 100;
constexpr double kSurely = 3.0;  // times what scatter makes of a straight line
constexpr double kNotCovered = std::numeric_limits<double>::infinity();

struct Curve {
  std::span<const double> time_s, value;
  double max_gap_s = 0.0;

  // NaN outside the curve and in its gaps.
  double at(double at_s) const {
    const std::optional<Place> place = place_of(time_s, at_s);
    if (!place || (place->share > 0.0 && time_s[place->row + 1] - time_s[place->row] > max_gap_s)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    return value_at(value, *place);
  }
};

struct Samples {
  std::vector<double> time_s, value;
};

double variance_at(const Samples& samples, const Curve& curve, double shift_s) {
  double sum = 0.0, squares = 0.0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < samples.time_s.size(); ++i) {
    const double apart = samples.value[i] - curve.at(samples.time_s[i] - shift_s);
    if (std::isnan(apart)) continue;
    sum += apart;
    squares += apart * apart;
    ++n;
  }
  if (n < 4 || 3 * n < 2 * samples.time_s.size()) return kNotCovered;
  const auto count = static_cast<double>(n);
  return std::max(0.0, squares / count - sum * sum / (count * count));
}

// Whether the slope of the curve changes by more than scatter of that variance makes it seem to; a straight line
// agrees at every shift. Slopes over a tenth of the samples' time, shorter at the curve's ends.
bool bends(const Samples& samples, const Curve& curve, double shift_s, double variance) {
  const double half_s = (samples.time_s.back() - samples.time_s.front()) / 20.0;
  double sum = 0.0, squares = 0.0, scatter = 0.0;
  std::size_t n = 0;
  for (const double at_s : samples.time_s) {
    const double from_s = std::max(at_s - shift_s - half_s, curve.time_s.front());
    const double to_s = std::min(at_s - shift_s + half_s, curve.time_s.back());
    if (to_s - from_s < half_s) continue;
    const double slope = (curve.at(to_s) - curve.at(from_s)) / (to_s - from_s);
    if (std::isnan(slope)) continue;
    sum += slope;
    squares += slope * slope;
    scatter += 2.0 * variance / ((to_s - from_s) * (to_s - from_s));
    ++n;
  }
  if (n < 4) return false;
  constexpr double kRounding = 1e-9;
  return squares - sum * sum / static_cast<double>(n) > std::max(kSurely * scatter, kRounding * squares);
}

// Where the parabola through three equidistant points is least, in steps from the middle one.
double vertex(double before, double middle, double after) {
  const double bend = before - 2.0 * middle + after;
  return bend > 0.0 ? 0.5 * (before - after) / bend : 0.0;
}

}  // namespace

std::optional<BestLag> best_lag(std::span<const double> time_s, std::span<const double> value,
                                std::span<const double> curve_time_s, std::span<const double> curve_value,
                                double max_gap_s, double sigma) {
  Samples samples;
  const std::size_t stride = 1 + time_s.size() / kMostSamples;
  for (std::size_t i = 0; i < time_s.size(); i += stride) {
    samples.time_s.push_back(time_s[i]);
    samples.value.push_back(value[i]);
  }
  const Curve curve{curve_time_s, curve_value, max_gap_s};
  double step_s = (time_s.back() - time_s.front()) / (4.0 * kStepsEachWay);
  double best_s = 0.0;
  double least = variance_at(samples, curve, 0.0);
  int best = 0;
  for (int i = -kStepsEachWay; i <= kStepsEachWay; ++i) {
    const double now = variance_at(samples, curve, i * step_s);
    if (now < least) {
      least = now;
      best = i;
    }
  }
  best_s = best * step_s;
  if (std::isinf(variance_at(samples, curve, best_s - step_s)) ||
      std::isinf(variance_at(samples, curve, best_s + step_s)) || std::abs(best) == kStepsEachWay) {
    return std::nullopt;
  }
  for (int round = 0; round < 3; ++round) {
    const double middle = variance_at(samples, curve, best_s);
    best_s += step_s * std::clamp(vertex(variance_at(samples, curve, best_s - step_s), middle,
                                         variance_at(samples, curve, best_s + step_s)),
                                  -1.0, 1.0);
    step_s /= 4.0;
  }
  // Slope of the curve over a step of the search: sigma^2 = residual^2 / sum (slope - mean slope)^2.
  const double half_s = (time_s.back() - time_s.front()) / (8.0 * kStepsEachWay);
  double sum = 0.0, squares = 0.0;
  std::size_t n = 0;
  for (const double at_s : samples.time_s) {
    const double slope = (curve.at(at_s - best_s + half_s) - curve.at(at_s - best_s - half_s)) / (2.0 * half_s);
    if (std::isnan(slope)) continue;
    sum += slope;
    squares += slope * slope;
    ++n;
  }
  if (n < 4) return std::nullopt;
  const auto count = static_cast<double>(n);
  const double information = squares - sum * sum / count;
  if (!(information > 0.0)) return std::nullopt;
  // The best of many shifts leaves too small a residual: never below what is stated.
  const double variance = std::max(sigma * sigma, variance_at(samples, curve, best_s) * count / (count - 2.0));
  if (!bends(samples, curve, best_s, variance)) return std::nullopt;
  return BestLag{best_s, std::sqrt(variance / information)};
}

}  // namespace ballbar

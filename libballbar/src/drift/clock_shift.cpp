#include "drift/clock_shift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/not_finite.hpp"

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
      return kUnknown;
    }
    return value_at(value, *place);
  }
};

// The smoothed curve: a local least squares parabola over +-half_s, at rows at least a sixteenth of that apart, linear
// between those; with fewer than 5 rows within half_s the row itself. Gaps stay gaps. O(n): each row is used in at most
// 32 parabolas.
struct Smooth {
  std::vector<double> value;      // as the rows
  double scatter_variance = 0.0;  // of a single row
  double kept = 1.0;              // share of that variance that is left in `value`
};

Smooth smoothed(const Curve& curve, double half_s) {
  const std::span<const double> time_s = curve.time_s, value = curve.value;
  Smooth smooth{std::vector<double>(value.begin(), value.end())};
  double squares = 0.0, freedom = 0.0, kept = 0.0;
  std::size_t nodes = 0, begin = 0, end = 0;
  std::optional<std::size_t> before;
  for (std::size_t row = 0; row < value.size(); ++row) {
    if (std::isnan(value[row])) continue;
    if (before && row + 1 < value.size() && time_s[row] - time_s[*before] < half_s / 16.0) continue;
    while (time_s[begin] < time_s[row] - half_s) ++begin;
    while (end < value.size() && time_s[end] <= time_s[row] + half_s) ++end;
    double u0 = 0.0, u1 = 0.0, u2 = 0.0, u3 = 0.0, u4 = 0.0, v0 = 0.0, v1 = 0.0, v2 = 0.0;
    for (std::size_t k = begin; k < end; ++k) {
      if (std::isnan(value[k])) continue;
      const double u = (time_s[k] - time_s[row]) / half_s, uu = u * u;
      u0 += 1.0;
      u1 += u;
      u2 += uu;
      u3 += uu * u;
      u4 += uu * uu;
      v0 += value[k];
      v1 += value[k] * u;
      v2 += value[k] * uu;
    }
    // First row of the inverse of the normal equations, times their determinant: the parabola at u = 0.
    const double c0 = u2 * u4 - u3 * u3, c1 = u2 * u3 - u1 * u4, c2 = u1 * u3 - u2 * u2;
    const double determinant = u0 * c0 + u1 * c1 + u2 * c2;
    double weight = 1.0;  // of the row in its own parabola
    if (u0 >= 5.0 && determinant > 0.0) {
      weight = c0 / determinant;
      smooth.value[row] = (c0 * v0 + c1 * v1 + c2 * v2) / determinant;
      squares += (value[row] - smooth.value[row]) * (value[row] - smooth.value[row]);
      freedom += 1.0 - weight;
    }
    kept += weight;
    ++nodes;
    for (std::size_t k = before.value_or(row); k < row; ++k) {
      if (k == *before || std::isnan(value[k])) continue;
      const double share = (time_s[k] - time_s[*before]) / (time_s[row] - time_s[*before]);
      smooth.value[k] = (1.0 - share) * smooth.value[*before] + share * smooth.value[row];
    }
    before = row;
  }
  if (freedom > 0.0) smooth.scatter_variance = squares / freedom;
  if (nodes > 0) smooth.kept = kept / static_cast<double>(nodes);
  return smooth;
}

struct Samples {
  std::vector<double> time_s, value;
};

double variance_at(const Samples& samples, const Curve& curve, double shift_s) {
  double sum = 0.0, squares = 0.0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < samples.time_s.size(); ++i) {
    const double difference = samples.value[i] - curve.at(samples.time_s[i] - shift_s);
    if (std::isnan(difference)) continue;
    sum += difference;
    squares += difference * difference;
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

std::optional<ClockShift> clock_shift(std::span<const double> time_s, std::span<const double> value,
                                      std::span<const double> curve_time_s, std::span<const double> curve_value,
                                      double max_gap_s, double sigma, double curve_sigma) {
  Samples samples;
  const std::size_t stride = 1 + time_s.size() / kMostSamples;
  for (std::size_t i = 0; i < time_s.size(); i += stride) {
    samples.time_s.push_back(time_s[i]);
    samples.value.push_back(value[i]);
  }
  const double span_s = time_s.back() - time_s.front();
  const Smooth smooth =
      smoothed({curve_time_s, curve_value, max_gap_s}, std::max(span_s / 30.0, 3.01 * median_step_s(curve_time_s)));
  const Curve curve{curve_time_s, smooth.value, max_gap_s};
  double step_s = span_s / (4.0 * kStepsEachWay);
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
  const double half_s = span_s / (8.0 * kStepsEachWay);
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
  // The smoothed curve's scatter is shared by neighbouring samples, so that it averages out over the samples only as
  // that of the rows does: what the residual does not show of it is added.
  const auto rows_end = std::upper_bound(curve_time_s.begin(), curve_time_s.end(), time_s.back());
  const auto rows = rows_end - std::lower_bound(curve_time_s.begin(), curve_time_s.end(), time_s.front());
  const double samples_a_row = static_cast<double>(samples.time_s.size()) / static_cast<double>(rows);
  const double share = std::max(smooth.kept, std::min(1.0, samples_a_row));
  const double residual = variance_at(samples, curve, best_s) * count / (count - 2.0);
  const double found = residual + (share - smooth.kept) * smooth.scatter_variance;
  const double stated = sigma * sigma + share * curve_sigma * curve_sigma;
  // The residual of the best of many shifts is too small; sigma is never below the stated one.
  const double variance = std::max(stated, found);
  if (!bends(samples, curve, best_s, variance)) return std::nullopt;
  return ClockShift{best_s, std::sqrt(variance / information)};
}

}  // namespace ballbar

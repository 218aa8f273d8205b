#include "ballbar/internal/series/clock_lag.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "ballbar/internal/numerics/order_statistic.hpp"

namespace ballbar {
namespace {

constexpr double kLeastCorrelation = 0.7;
constexpr double kAlike = 0.01;  // insignificant difference of two correlations
constexpr std::size_t kMostRows = 4000, kFewestRows = 20;
constexpr int kMostLags = 600;
constexpr int kBitsOfLag = 26;  // where it is least a function does not change over half the bits of a double

// Values of a column, gaps left out.
struct Curve {
  std::vector<double> time_s, value;
};

Curve curve_of(const Series& series, const Column& column) {
  Curve curve;
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    if (!std::isfinite(column.values[i])) continue;
    curve.time_s.push_back(series.time_s[i]);
    curve.value.push_back(column.values[i]);
  }
  return curve;
}

// Straight lines between the rows; both rise.
std::vector<double> at_times(const Curve& curve, const std::vector<double>& time_s) {
  std::vector<double> values;
  values.reserve(time_s.size());
  std::size_t k = 1;
  for (const double t : time_s) {
    while (k + 1 < curve.time_s.size() && curve.time_s[k] < t) ++k;
    const double share = (t - curve.time_s[k - 1]) / (curve.time_s[k] - curve.time_s[k - 1]);
    values.push_back(curve.value[k - 1] + share * (curve.value[k] - curve.value[k - 1]));
  }
  return values;
}

struct Match {
  double correlation = 0.0;
  double left = 1.0;    // 1 - r^2
  double memory = 0.0;  // correlation of the residual from row to row
  std::size_t rows = 0;
};

// The second moved by `lag_s`, on the rows of the first that it covers.
Match match_at(const Curve& first, const Curve& second, double lag_s, double step_s) {
  const double from_s = std::max(first.time_s.front(), second.time_s.front() + lag_s);
  const double to_s = std::min(first.time_s.back(), second.time_s.back() + lag_s);
  Match match;
  if (!(to_s - from_s > static_cast<double>(kFewestRows) * step_s)) return match;
  const auto rows = std::min(kMostRows, static_cast<std::size_t>((to_s - from_s) / step_s));
  std::vector<double> t(rows), moved(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    t[i] = from_s + (to_s - from_s) * (static_cast<double>(i) + 0.5) / static_cast<double>(rows);
    moved[i] = t[i] - lag_s;
  }
  const std::vector<double> a = at_times(first, t), b = at_times(second, moved);
  double mean_a = 0.0, mean_b = 0.0;
  for (std::size_t i = 0; i < rows; ++i) mean_a += a[i], mean_b += b[i];
  mean_a /= static_cast<double>(rows);
  mean_b /= static_cast<double>(rows);
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < rows; ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  if (!(aa > 0.0 && bb > 0.0)) return match;
  match.rows = rows;
  match.correlation = ab / std::sqrt(aa * bb);
  match.left = std::max(1e-12, 1.0 - match.correlation * match.correlation);
  double before = 0.0, squares = 0.0, products = 0.0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double residual = (a[i] - mean_a) - ab / bb * (b[i] - mean_b);
    squares += residual * residual;
    products += i > 0 ? residual * before : 0.0;
    before = residual;
  }
  match.memory = squares > 0.0 ? std::clamp(products / squares, 0.0, 0.99) : 0.0;
  return match;
}

std::optional<ClockLag> lag_of(const Curve& first, const Curve& second, double range_s) {
  if (first.time_s.size() < kFewestRows || second.time_s.size() < kFewestRows) return std::nullopt;
  const auto [fine_s, slow_s] = std::minmax({median_step_s(first.time_s), median_step_s(second.time_s)});
  const double step_s = std::max(2.0 * range_s / kMostLags, 0.5 * slow_s);
  const int most = static_cast<int>(range_s / step_s);
  std::vector<double> correlations;
  correlations.reserve(2 * static_cast<std::size_t>(most) + 1);
  int best = -most;
  double largest = -1.0;
  for (int k = -most; k <= most; ++k) {
    const double r = match_at(first, second, k * step_s, slow_s).correlation;
    correlations.push_back(r);
    if (r > largest) largest = r, best = k;
  }
  if (largest < kLeastCorrelation) return std::nullopt;
  // Down both slopes of the peak; what stands beyond them is another.
  const auto at = [&](int k) { return correlations[static_cast<std::size_t>(k + most)]; };
  int low = best, high = best;
  while (low > -most && at(low - 1) < at(low)) --low;
  while (high < most && at(high + 1) < at(high)) ++high;
  for (int k = -most; k <= most; ++k) {
    if (k < low || k > high) {
      if (1.0 - at(k) < 2.0 * (1.0 - largest) + kAlike) return std::nullopt;
    }
  }
  if (best == -most || best == most) return std::nullopt;  // the best lies beyond
  const auto left_at = [&, step_s = slow_s](double lag_s) { return match_at(first, second, lag_s, step_s).left; };
  ClockLag lag;
  lag.lag_s =
      boost::math::tools::brent_find_minima(left_at, (best - 1) * step_s, (best + 1) * step_s, kBitsOfLag).first;
  const Match match = match_at(first, second, lag.lag_s, slow_s);
  lag.correlation = match.correlation;
  const double h = slow_s;
  const double curvature = (left_at(lag.lag_s + h) - 2.0 * match.left + left_at(lag.lag_s - h)) / (h * h);
  const double free_rows = static_cast<double>(match.rows) * (1.0 - match.memory) / (1.0 + match.memory);
  const double of_fit =
      curvature > 0.0 ? std::sqrt(2.0 * match.left / (std::max(3.0, free_rows) * curvature)) : range_s;
  // All steps of a programme lie at the same place between rows, so that more steps give no more information.
  const double of_rows = std::hypot(slow_s, fine_s) / std::sqrt(12.0);
  lag.sigma_s = std::hypot(of_fit, of_rows);
  return lag;
}

bool show_the_same(const Column& a, const Column& b) {
  if (a.role == Role::measured || b.role == Role::measured || a.role == Role::event || b.role == Role::event)
    return a.name == b.name;
  const auto either = [&](Role one, Role other) {
    return (a.role == one && b.role == other) || (a.role == other && b.role == one);
  };
  return a.name == b.name || (a.role == Role::speed && b.role == Role::speed) || either(Role::speed, Role::load) ||
         (a.role == Role::load && b.role == Role::load) || (a.role == Role::ambient && b.role == Role::ambient) ||
         (a.role == Role::coolant && b.role == Role::coolant);
}

}  // namespace

std::optional<ClockLag> clock_lag(const Series& first, const Series& second, double range_s) {
  std::optional<ClockLag> best;
  for (const Column& a : first.columns) {
    for (const Column& b : second.columns) {
      if (!show_the_same(a, b)) continue;
      auto lag = lag_of(curve_of(first, a), curve_of(second, b), range_s);
      if (!lag || (best && best->correlation >= lag->correlation)) continue;
      lag->column = a.name;
      lag->other = b.name;
      best = lag;
    }
  }
  return best;
}

}  // namespace ballbar

#include "ballbar/internal/series/zone_shift.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "ballbar/internal/numerics/order_statistic.hpp"

namespace ballbar {
namespace {

constexpr double kQuarter_s = 900.0, kHour_s = 3600.0, kMost_s = 14.0 * kHour_s;
constexpr double kChanges_s[] = {300.0, 900.0, 3600.0};  // over which changes are compared
constexpr double kLeastScore = 6.0, kBeforeOthers = 1.5, kNearlyAsLarge = 0.9;
constexpr std::size_t kFewestChanges = 24, kMostChanges = 20000, kMostPairs = 300;

bool is_temperature(const Column& column) {
  return column.role != Role::measured && column.role != Role::event && unit_of(column.name) == "degC";
}

bool may_change_together(const Column& a, const Column& b) {
  if (a.name == b.name || (is_temperature(a) && is_temperature(b))) return true;
  return a.role == b.role && (a.role == Role::speed || a.role == Role::load);
}

// Changes of a column on a grid of whole steps since time 0; a gap is NaN.
struct Changes {
  long first = 0;  // step of the first change
  std::vector<double> value;
  double memory = 0.0;  // correlation of a change with the one before
};

Changes changes_of(const Series& series, const Column& column, double step_s) {
  std::vector<double> time_s, known;
  for (std::size_t row = 0; row < series.time_s.size(); ++row) {
    if (!std::isfinite(column.values[row])) continue;
    time_s.push_back(series.time_s[row]);
    known.push_back(column.values[row]);
  }
  Changes changes;
  if (known.size() < kFewestChanges) return changes;
  changes.first = static_cast<long>(std::ceil(time_s.front() / step_s));
  const auto last = static_cast<long>(std::floor(time_s.back() / step_s));
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::size_t next = 1;
  double before = kNone;
  for (long step = changes.first; step <= last && changes.value.size() < kMostChanges; ++step) {
    const double t_s = static_cast<double>(step) * step_s;
    while (next + 1 < time_s.size() && time_s[next] < t_s) ++next;
    const double wide_s = time_s[next] - time_s[next - 1];
    const double share = (t_s - time_s[next - 1]) / wide_s;
    const double here = wide_s > 3.0 * step_s ? kNone : known[next - 1] + share * (known[next] - known[next - 1]);
    changes.value.push_back(here - before);
    before = here;
  }
  double squares = 0.0, products = 0.0;
  for (std::size_t i = 1; i < changes.value.size(); ++i) {
    const double product = changes.value[i] * changes.value[i - 1];
    if (!std::isfinite(product)) continue;
    products += product;
    squares += changes.value[i] * changes.value[i];
  }
  changes.memory = squares > 0.0 ? std::clamp(products / squares, 0.0, 0.95) : 0.0;
  return changes;
}

struct Score {
  double score = 0.0, correlation = 0.0;
};

// The second `steps` later.
Score score_at(const Changes& a, const Changes& b, long steps, bool rise_together) {
  const long from = std::max(a.first, b.first + steps);
  const long to =
      std::min(a.first + static_cast<long>(a.value.size()), b.first + steps + static_cast<long>(b.value.size()));
  double aa = 0.0, bb = 0.0, ab = 0.0;
  std::size_t count = 0;
  for (long step = from; step < to; ++step) {
    const double x = a.value[static_cast<std::size_t>(step - a.first)];
    const double y = b.value[static_cast<std::size_t>(step - steps - b.first)];
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    aa += x * x;
    bb += y * y;
    ab += x * y;
    ++count;
  }
  if (count < kFewestChanges || !(aa > 0.0 && bb > 0.0)) return {};
  const double correlation = ab / std::sqrt(aa * bb), memory = a.memory * b.memory;
  const double independent = static_cast<double>(count) * (1.0 - memory) / (1.0 + memory);
  const double z = std::atanh(std::min(std::abs(correlation), 0.999)) * std::sqrt(std::max(0.0, independent - 3.0));
  return {rise_together && correlation < 0.0 ? 0.0 : z, correlation};
}

// Of one pair of columns, with changes over one time.
void try_pair(const Changes& a, const Changes& b, double step_s, bool rise_together, bool is_one_quantity,
              double& best_score, ZoneShift& best) {
  const double shift_s = std::max(step_s, kQuarter_s);
  const auto steps = static_cast<long>(shift_s / step_s), most = static_cast<long>(kMost_s / shift_s);
  std::vector<Score> scores;
  for (long k = -most; k <= most; ++k) scores.push_back(score_at(a, b, k * steps, rise_together));
  const auto at = [&](long k) { return scores[static_cast<std::size_t>(k + most)]; };
  long top = -most;
  for (long k = -most; k <= most; ++k) {
    if (at(k).score > at(top).score) top = k;
  }
  const double score = at(top).score;
  if (score < kLeastScore || score <= best_score) return;
  long low = top, high = top;
  while (low > -most && at(low - 1).score < at(low).score) --low;
  while (high < most && at(high + 1).score < at(high).score) ++high;
  for (long k = -most; k <= most; ++k) {
    if ((k < low || k > high) && kBeforeOthers * at(k).score > score) return;
  }
  best_score = score;
  if (low <= 0 && high >= 0) return;  // they agree as they are
  const long hour = static_cast<long>(kHour_s / shift_s);
  const long whole = std::lround(static_cast<double>(top) / static_cast<double>(hour)) * hour;
  if (whole >= low && whole <= high && at(whole).score > kNearlyAsLarge * score) top = whole;
  if (!is_one_quantity && std::fmod(static_cast<double>(top) * shift_s, 0.5 * kHour_s) != 0.0) return;
  best.shift_s = static_cast<double>(top) * shift_s;
  best.correlation = at(top).correlation;
  best.correlation_now = at(0).correlation;
}

}  // namespace

std::optional<ZoneShift> zone_shift(const Series& first, const Series& second) {
  std::optional<ZoneShift> found;
  if (first.time_s.size() < kFewestChanges || second.time_s.size() < kFewestChanges) return found;
  const double slow_s = std::max(median_step_s(first.time_s), median_step_s(second.time_s));
  double best_score = 0.0;
  for (const double step_s : kChanges_s) {
    if (step_s < slow_s) continue;
    std::size_t pairs = 0;
    std::vector<Changes> others;
    for (const Column& b : second.columns) others.push_back(changes_of(second, b, step_s));
    for (const Column& a : first.columns) {
      const Changes changes = changes_of(first, a, step_s);
      for (std::size_t k = 0; k < second.columns.size(); ++k) {
        const Column& b = second.columns[k];
        if (!may_change_together(a, b) || ++pairs > kMostPairs) continue;
        ZoneShift one{a.name, b.name, 0.0, 0.0, 0.0};
        const double before = best_score;
        try_pair(changes, others[k], step_s, is_temperature(a) && is_temperature(b), a.name == b.name, best_score, one);
        if (best_score > before) found = one.shift_s == 0.0 ? std::nullopt : std::optional(one);
      }
    }
  }
  return found;
}

}  // namespace ballbar

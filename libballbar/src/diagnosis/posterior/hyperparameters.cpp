#include "diagnosis/posterior/hyperparameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "diagnosis/evidence/linear_model.hpp"
#include "noise/discrepancy_grid.hpp"

namespace ballbar {
namespace {

// The grid from whose best point the search starts: memories, and sizes of a discrepancy over those of the noise.
constexpr std::size_t kLengths = 4;
constexpr double kFirstSizes[] = {1.0, 4.0, 16.0};

// A compass search between bounds: ln of white over what is new of the memory in a step, ln of the memory, ln of the
// discrepancy's standard deviation over the noise's, ln of its memory. Those that are not searched have equal bounds.
using Place = std::array<double, 4>;

struct Limits {
  Place low, high;
  double step_s = 1.0, most_new = 0.0;
  Discrepancy kind = Discrepancy::none;
  std::size_t free() const {
    std::size_t count = 0;
    for (std::size_t k = 0; k < low.size(); ++k) count += high[k] > low[k] ? 1 : 0;
    return count;
  }
};

Limits limits_of(const Problem& problem, Discrepancy kind) {
  Limits bounds;
  bounds.kind = kind;
  bounds.most_new = problem.tuning.most_new;
  const double median_s = median_step_s(problem.time_s), span_s = span_of_time_s(problem.time_s);
  bounds.step_s = median_s > 0.0 ? median_s : 1.0;
  bounds.low.fill(0.0);
  bounds.high.fill(0.0);
  const double memory_s = std::min(problem.longest_memory_s, std::max(3.0 * bounds.step_s, span_s / 6.0));
  bounds.low[0] = bounds.high[0] = std::numeric_limits<double>::infinity();  // white alone
  if (problem.time_s.size() >= problem.tuning.fewest_for_memory && memory_s > 2.5 * bounds.step_s) {
    bounds.low[0] = -problem.tuning.most_white;
    bounds.high[0] = problem.tuning.most_white;
    bounds.low[1] = std::log(bounds.step_s);
    bounds.high[1] = std::log(memory_s);
  }
  if (kind == Discrepancy::none) return bounds;
  bounds.low[2] = std::log(0.3);
  bounds.high[2] = std::log(300.0);
  const double shortest_s =
      std::max(problem.tuning.shortest_discrepancy * problem.longest_memory_s, 2.0 * bounds.step_s);
  bounds.low[3] = std::log(shortest_s);
  bounds.high[3] = std::log(std::max(3.0 * span_s, 2.0 * shortest_s));
  return bounds;
}

Covariance covariance_at(const Limits& bounds, const Place& x) {
  Covariance result;
  if (std::isfinite(x[0])) result = with_memory(1.0, x[0], bounds.step_s, std::exp(x[1]));
  if (bounds.kind == Discrepancy::none) return result;
  result.slow = std::exp(2.0 * x[2]);
  result.slow_time_s = std::exp(x[3]);
  result.slow_is_rough = bounds.kind == Discrepancy::rough;
  if (result.slow_is_rough) {
    // From row to row the noise is no smaller than this share of the discrepancy's changes, or that would be the noise.
    const double changes = -std::expm1(-2.0 * bounds.step_s / result.slow_time_s);
    result.slow = std::min(result.slow, bounds.most_new * bounds.most_new / changes);
  }
  return result;
}

Place place_of(const Limits& bounds, const Covariance& covariance) {
  Place x = bounds.low;
  if (std::isfinite(x[0]) && covariance.correlated > 0.0) {
    x[0] = -std::log(covariance.correlated / covariance.white * -std::expm1(-2.0 * bounds.step_s / covariance.time_s));
    x[1] = std::log(covariance.time_s);
  } else if (std::isfinite(x[0])) {
    x[0] = bounds.high[0];
  }
  if (covariance.slow > 0.0) {
    x[2] = 0.5 * std::log(covariance.slow);
    x[3] = std::log(covariance.slow_time_s);
  } else {
    x[3] = 0.5 * (bounds.low[3] + bounds.high[3]);
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (bounds.high[k] > bounds.low[k]) x[k] = std::clamp(x[k], bounds.low[k], bounds.high[k]);
  }
  return x;
}

// Where a first look begins.
std::vector<Place> starts_of(const Limits& bounds) {
  std::vector<Place> noises;
  Place x = bounds.low;
  if (bounds.high[1] > bounds.low[1]) {
    const std::vector<double> shares = bounds.kind == Discrepancy::none ? std::vector{0.2, 0.6, 1.0} : std::vector{0.4};
    const std::vector<double> whites =
        bounds.kind == Discrepancy::none ? std::vector{2.5, 0.3, -4.0} : std::vector{2.5, -1.0};
    for (const double share : shares) {
      for (const double white : whites) {
        x[0] = white;
        x[1] = bounds.low[1] + share * (bounds.high[1] - bounds.low[1]);
        noises.push_back(x);
      }
    }
  } else {
    noises.push_back(x);
  }
  if (bounds.kind == Discrepancy::none) return noises;
  std::vector<Place> starts;
  for (Place one : noises) {
    for (std::size_t length = 0; length < kLengths; ++length) {
      for (const double size : kFirstSizes) {
        one[2] = std::log(size);
        one[3] = bounds.low[3] + (bounds.high[3] - bounds.low[3]) * static_cast<double>(length) / (kLengths - 1.0);
        starts.push_back(one);
      }
    }
  }
  return starts;
}

}  // namespace

Discrepancy discrepancy_of(const Covariance& covariance) {
  if (!(covariance.slow > 0.0)) return Discrepancy::none;
  return covariance.slow_is_rough ? Discrepancy::rough : Discrepancy::smooth;
}

std::vector<Discrepancy> discrepancies_of(const Problem& problem) {
  if (problem.model.level != Level::series || problem.time_s.size() < 12 || !(problem.tuning.discrepancy > 0.0))
    return {Discrepancy::none};
  return {Discrepancy::none, Discrepancy::rough, Discrepancy::smooth};
}

Covariance likeliest_covariance(const Problem& problem, const LinearModel& linear, Discrepancy kind,
                                const Covariance* start) {
  const Limits bounds = limits_of(problem, kind);
  const auto log_evidence_at = [&](const Place& x) {
    const NoiseFilter filter = noise_filter_at(problem, covariance_at(bounds, x));
    return linear_solution(filter.whitening, linear, problem.known).log_evidence;
  };
  std::vector<Place> starts = start != nullptr ? std::vector{place_of(bounds, *start)} : starts_of(bounds);
  std::vector<double> evidence(starts.size());
  in_parallel(starts.size(), [&](std::size_t k) { evidence[k] = log_evidence_at(starts[k]); });
  const auto first = static_cast<std::size_t>(std::max_element(evidence.begin(), evidence.end()) - evidence.begin());
  Place best = starts[first];
  double most = evidence[first];
  for (double step = start != nullptr ? 0.5 * problem.tuning.first_step : problem.tuning.first_step;
       step >= problem.tuning.last_step && bounds.free() > 0;) {
    bool is_better = false;
    for (std::size_t k = 0; k < best.size(); ++k) {
      if (!(bounds.high[k] > bounds.low[k])) continue;
      for (const double sign : {1.0, -1.0}) {
        Place next = best;
        next[k] = std::clamp(best[k] + sign * step, bounds.low[k], bounds.high[k]);
        if (next[k] == best[k]) continue;
        const double there = log_evidence_at(next);
        if (!(there > most + 0.02)) continue;
        best = next;
        most = there;
        is_better = true;
        break;
      }
    }
    if (!is_better) step *= 0.5;
  }
  Covariance result = covariance_at(bounds, best);
  const bool has_kinds = problem.model.level == Level::series;
  const double kinds = kind == Discrepancy::none ? 1.0 - problem.tuning.discrepancy : 0.5 * problem.tuning.discrepancy;
  result.log_prior =
      (has_kinds ? std::log(kinds) : 0.0) - problem.tuning.hyperparameter * static_cast<double>(bounds.free());
  return result;
}

std::vector<Covariance> likeliest_covariances(const Problem& problem, const LinearModel& linear) {
  if (!problem.covariances.empty()) return problem.covariances;
  const std::vector<Discrepancy> kinds = discrepancies_of(problem);
  std::vector<Covariance> found(kinds.size());
  in_parallel(kinds.size(), [&](std::size_t k) { found[k] = likeliest_covariance(problem, linear, kinds[k]); });
  return found;
}

NoiseFilter likeliest_filter(const Problem& problem, const LinearModel& linear) {
  NoiseFilter best;
  double most = kLogZero;
  for (const Covariance& covariance : likeliest_covariances(problem, linear)) {
    NoiseFilter one = noise_filter_at(problem, covariance);
    const double log_weight = linear_solution(one.whitening, linear, problem.known).log_evidence + covariance.log_prior;
    if (!(log_weight > most)) continue;
    most = log_weight;
    best = std::move(one);
  }
  return best;
}

}  // namespace ballbar

#include "ballbar/drift/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "drift/clock_shift.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/not_finite.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr double kChance = 0.01;

void expect_comparable(const MeasuredDrift& a, const MeasuredDrift& b) {
  for (const MeasuredDrift* drift : {&a, &b}) {
    if (drift->time_s.empty()) throw Error(fmt::format("expected rows to compare, found none in {}.", drift->what));
  }
  bool any = false;
  for (const DriftAxis& axis : a.axes) {
    const DriftAxis* other = find_axis(b, axis.name);
    if (other == nullptr) continue;
    any = true;
    if (other->unit == axis.unit) continue;
    throw Error(fmt::format("expected {} in one unit, found {}_{} in {} and {}_{} in {}.", axis.name, axis.name,
                            axis.unit, a.what, axis.name, other->unit, b.what));
  }
  const auto names = [](const MeasuredDrift& drift) {
    std::vector<std::string> found;
    for (const DriftAxis& axis : drift.axes) found.push_back(axis.name);
    return found.empty() ? std::string("none") : fmt::format("{}", fmt::join(found, ", "));
  };
  if (!any) {
    throw Error(fmt::format("expected an axis that both have, found {} in {} and {} in {}.", names(a), a.what, names(b),
                            b.what));
  }
  if (a.time_s.front() > b.time_s.back() || b.time_s.front() > a.time_s.back()) {
    const auto range = [](const MeasuredDrift& drift) {
      return fmt::format("{:g} to {:g} min in {}", min_from_s(drift.time_s.front()), min_from_s(drift.time_s.back()),
                         drift.what);
    };
    throw Error(fmt::format("expected times in common, found {} and {}.", range(a), range(b)));
  }
}

// One axis of one side at the common times: value, and sigma by source, both as since the row `zero`.
struct Side {
  std::vector<double> value;
  std::vector<Contribution> budget;
};

Side side_at(const DriftAxis& axis, const std::vector<Place>& places, std::size_t zero) {
  const auto at = [&](const std::vector<double>& column) {
    std::vector<double> values;
    values.reserve(places.size());
    for (const Place& place : places) values.push_back(value_at(column, place));
    return values;
  };
  Side side{at(axis.value), {}};
  const double zero_value = side.value[zero];
  for (double& value : side.value) value -= zero_value;
  for (const Contribution& contribution : axis.budget) {
    std::vector<double> sigma = at(contribution.sigma);
    const double zero_sigma = std::isnan(sigma[zero]) ? 0.0 : sigma[zero];
    for (double& s : sigma) s = std::hypot(s, zero_sigma);
    sigma[zero] = 0.0;
    side.budget.push_back({contribution.source, std::move(sigma)});
  }
  return side;
}

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

std::optional<double> correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean(a), mean_b = mean(b);
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  if (!(aa > 0.0 && bb > 0.0)) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

// P(at least k of n samples beyond 2 sigma) where half of each variance is an error that all share: that of the zero.
// The shared part c is integrated over; beyond 2 sigma is then |sqrt(1/2) c + sqrt(1/2) e| > 2 of the own part e.
double chance_of_beyond(std::size_t k, std::size_t n) {
  if (k == 0) return 1.0;
  constexpr double kStep = 0.05, kFarthest = 6.0;
  double probability = 0.0;
  for (double c = -kFarthest; c <= kFarthest; c += kStep) {
    const double density = std::exp(-0.5 * c * c) / std::sqrt(2.0 * std::numbers::pi);
    const double above = 0.5 * std::erfc((2.0 - std::sqrt(0.5) * c) / std::sqrt(0.5) / std::numbers::sqrt2);
    const double below = 0.5 * std::erfc((2.0 + std::sqrt(0.5) * c) / std::sqrt(0.5) / std::numbers::sqrt2);
    const double p = std::clamp(above + below, 1e-12, 1.0 - 1e-12);
    probability += density * kStep * binomial_upper_tail(k, n, p);
  }
  return probability;
}

double deviation_in_sigma(const AxisComparison& axis, std::size_t i) {
  if (!std::isfinite(axis.sigma[i]) || axis.difference[i] == 0.0) return 0.0;
  return std::abs(axis.difference[i]) / axis.sigma[i];  // infinite where sigma is 0
}

void decide_agreement(AxisComparison& axis, double reference_s) {
  std::size_t worst = 0;
  for (std::size_t i = 0; i < axis.time_s.size(); ++i) {
    if (axis.time_s[i] == reference_s || !std::isfinite(axis.sigma[i])) continue;
    ++axis.counted;
    if (deviation_in_sigma(axis, i) <= 2.0) ++axis.within;
    if (deviation_in_sigma(axis, i) > deviation_in_sigma(axis, worst)) worst = i;
  }
  if (axis.counted == 0) return;
  const double z = deviation_in_sigma(axis, worst);
  const double largest_by_chance =
      -std::expm1(static_cast<double>(axis.counted) * std::log1p(-std::erfc(z / std::numbers::sqrt2)));
  const bool too_many = chance_of_beyond(axis.counted - axis.within, axis.counted) < kChance;
  axis.agreement = too_many || largest_by_chance < kChance ? Agreement::disagrees : Agreement::agrees;
  if (z <= 2.0) return;
  const auto beyond = [&](std::size_t i) {
    return deviation_in_sigma(axis, i) > 2.0 && (axis.difference[i] > 0.0) == (axis.difference[worst] > 0.0);
  };
  std::size_t from = worst, to = worst;
  while (from > 0 && beyond(from - 1)) --from;
  while (to + 1 < axis.time_s.size() && beyond(to + 1)) ++to;
  axis.deviation = Deviation{axis.time_s[from],      axis.time_s[to],   to + 1 == axis.time_s.size(),
                             axis.difference[worst], axis.sigma[worst], axis.time_s[worst]};
}

void describe(AxisComparison& axis, double reference_s) {
  const std::size_t n = axis.difference.size();
  const auto [low, high] = std::minmax_element(axis.b.begin(), axis.b.end());
  const double range = *high - *low;
  double squares = 0.0, relative = 0.0, expected = 0.0, absolute = 0.0;
  std::size_t relative_samples = 0;
  std::vector<double> moved;  // differences, the reference left out: it is 0 by definition
  for (std::size_t i = 0; i < n; ++i) {
    const double d = axis.difference[i];
    if (std::abs(d) > std::abs(axis.largest) || i == 0) {
      axis.largest = d;
      axis.largest_s = axis.time_s[i];
    }
    if (axis.time_s[i] == reference_s) continue;
    moved.push_back(d);
    squares += d * d;
    absolute += std::abs(d);
    if (std::abs(axis.b[i]) > range / 10.0) {
      ++relative_samples;
      relative += std::abs(d / axis.b[i]);
      expected += std::sqrt(2.0 / std::numbers::pi) * axis.sigma[i] / std::abs(axis.b[i]);
    }
  }
  const auto count = static_cast<double>(moved.size());
  axis.rmse = std::sqrt(squares / count);
  axis.bias = mean(moved);
  if (moved.size() > 1) {
    double variance = 0.0;
    for (const double d : moved) variance += (d - axis.bias) * (d - axis.bias);
    const double sd = std::sqrt(variance / (count - 1.0));
    axis.limit_low = axis.bias - 1.96 * sd;
    axis.limit_high = axis.bias + 1.96 * sd;
  }
  if (range > 0.0) axis.range_deviation = absolute / count / range;
  if (relative_samples > 0) {
    axis.mean_relative_deviation = relative / static_cast<double>(relative_samples);
    if (std::isfinite(expected)) {
      axis.expected_relative_deviation = expected / static_cast<double>(relative_samples);
      if (relative > 0.0) axis.explained_share = std::min(1.0, expected / relative);
    }
  }
  axis.correlation = correlation(axis.a, axis.b);
}

std::vector<UncertaintyShare> shares_of(const std::vector<Contribution>& budget, std::size_t zero) {
  std::vector<UncertaintyShare> shares;
  double total = 0.0;
  for (const Contribution& contribution : budget) {
    double squares = 0.0;
    std::size_t known = 0;
    for (std::size_t i = 0; i < contribution.sigma.size(); ++i) {
      if (i == zero || !std::isfinite(contribution.sigma[i])) continue;
      squares += contribution.sigma[i] * contribution.sigma[i];
      ++known;
    }
    const double variance = known > 0 ? squares / static_cast<double>(known) : kUnknown;
    shares.push_back({contribution.source, std::sqrt(variance), variance});
    if (known > 0) total += variance;
  }
  for (UncertaintyShare& share : shares) share.variance = share.variance > 0.0 ? share.variance / total : 0.0;
  return shares;
}

double total_sigma(std::span<const UncertaintyShare> shares) {
  double variance = 0.0;
  for (const UncertaintyShare& share : shares) variance += std::isnan(share.sigma) ? 0.0 : share.sigma * share.sigma;
  return std::sqrt(variance);
}

// Times of `sparse` within `dense`, and their places in both.
struct CommonTimes {
  std::vector<double> time_s;
  std::vector<Place> sparse, dense;
  std::size_t left_out = 0;
};

CommonTimes common_times(const MeasuredDrift& sparse, const MeasuredDrift& dense, double max_gap_s) {
  CommonTimes common;
  for (std::size_t row = 0; row < sparse.time_s.size(); ++row) {
    const std::optional<Place> place = place_of(dense.time_s, sparse.time_s[row]);
    if (!place) continue;
    if (place->share > 0.0 && dense.time_s[place->row + 1] - dense.time_s[place->row] > max_gap_s) {
      ++common.left_out;
      continue;
    }
    common.time_s.push_back(sparse.time_s[row]);
    common.sparse.push_back({row, 0.0});
    common.dense.push_back(*place);
  }
  return common;
}

std::size_t rows_within(const MeasuredDrift& drift, double from_s, double to_s) {
  const auto first = std::lower_bound(drift.time_s.begin(), drift.time_s.end(), from_s);
  const auto last = std::upper_bound(drift.time_s.begin(), drift.time_s.end(), to_s);
  return static_cast<std::size_t>(last - first);
}

std::size_t nearest(const std::vector<double>& time_s, std::optional<double> wanted_s) {
  if (!wanted_s) return 0;
  std::size_t best = 0;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (std::abs(time_s[i] - *wanted_s) < std::abs(time_s[best] - *wanted_s)) best = i;
  }
  return best;
}

std::string sentence_of(const AxisComparison& axis) {
  const Deviation& deviation = *axis.deviation;
  std::string when;
  if (deviation.from_s == deviation.to_s && !deviation.to_the_end) {
    when = fmt::format("at {:g} min", min_from_s(deviation.from_s));
  } else {
    when = fmt::format("from {:g} min to {}", min_from_s(deviation.from_s),
                       deviation.to_the_end ? "the end" : fmt::format("{:g} min", min_from_s(deviation.to_s)));
  }
  return fmt::format("{} {}, by {:.2f} ± {:.2f} {} at {:g} min", axis.name, when, deviation.largest, deviation.sigma,
                     axis.unit, min_from_s(deviation.at_s));
}

}  // namespace

Comparison compare(const MeasuredDrift& a, const MeasuredDrift& b, const ComparisonOptions& options) {
  expect_comparable(a, b);
  const double from_s = std::max(a.time_s.front(), b.time_s.front());
  const double to_s = std::min(a.time_s.back(), b.time_s.back());
  const bool a_is_sparse = rows_within(a, from_s, to_s) <= rows_within(b, from_s, to_s);
  const MeasuredDrift& dense = a_is_sparse ? b : a;
  const double max_gap_s = options.max_gap_s.value_or(4.0 * median_step_s(dense.time_s));
  const CommonTimes common = common_times(a_is_sparse ? a : b, dense, max_gap_s);
  if (common.time_s.size() < 3) {
    const std::string where = from_s == to_s
                                  ? fmt::format("at {:g} min", min_from_s(from_s))
                                  : fmt::format("between {:g} and {:g} min", min_from_s(from_s), min_from_s(to_s));
    throw Error(fmt::format("expected at least 3 times in common, found {} {} in {} and {}.", common.time_s.size(),
                            where, a.what, b.what));
  }
  Comparison result;
  result.a = a.what;
  result.b = b.what;
  result.samples = common.time_s.size();
  result.left_out = common.left_out;
  result.remarks = a.remarks;
  result.remarks.insert(result.remarks.end(), b.remarks.begin(), b.remarks.end());
  for (const DriftAxis& axis_a : a.axes) {
    const DriftAxis* axis_b = find_axis(b, axis_a.name);
    if (axis_b == nullptr) continue;
    // Samples in which both have a value.
    CommonTimes own;
    for (std::size_t i = 0; i < common.time_s.size(); ++i) {
      const double sparse = value_at((a_is_sparse ? axis_a : *axis_b).value, common.sparse[i]);
      const double other = value_at((a_is_sparse ? *axis_b : axis_a).value, common.dense[i]);
      if (std::isnan(sparse) || std::isnan(other)) continue;
      own.time_s.push_back(common.time_s[i]);
      own.sparse.push_back(common.sparse[i]);
      own.dense.push_back(common.dense[i]);
    }
    if (own.time_s.size() < 3) {
      result.remarks.push_back(
          fmt::format("{} is not compared: both have a value at {} of the common times, 3 are needed.", axis_a.name,
                      own.time_s.size()));
      continue;
    }
    const std::size_t zero = nearest(own.time_s, options.reference_s);
    if (result.axes.empty()) result.reference_s = own.time_s[zero];
    Side side_a = side_at(axis_a, a_is_sparse ? own.sparse : own.dense, zero);
    Side side_b = side_at(*axis_b, a_is_sparse ? own.dense : own.sparse, zero);
    for (Contribution& contribution : side_b.budget) {
      for (Contribution& twin : side_a.budget) {
        if (twin.source != contribution.source) continue;
        twin.source += ", " + (a.what == b.what ? "the first" : a.what);
        contribution.source += ", " + (a.what == b.what ? "the second" : b.what);
      }
    }
    const std::size_t sources_of_a = side_a.budget.size();
    std::vector<Contribution> budget = std::move(side_a.budget);
    std::move(side_b.budget.begin(), side_b.budget.end(), std::back_inserter(budget));

    for (const auto& [side, what, other] :
         {std::tuple(&axis_a, &a.what, &b.what), std::tuple(axis_b, &b.what, &a.what)}) {
      if (!side->budget.empty() || budget.empty()) continue;
      result.remarks.push_back(
          fmt::format("{} states no uncertainty of {}: only that of {} counts.", *what, side->name, *other));
    }

    AxisComparison axis;
    axis.name = axis_a.name;
    axis.unit = axis_a.unit;
    axis.time_s = own.time_s;
    axis.a = std::move(side_a.value);
    axis.b = std::move(side_b.value);
    const DriftAxis total{axis.name, axis.unit, {}, budget};
    for (std::size_t i = 0; i < axis.time_s.size(); ++i) {
      axis.difference.push_back(axis.a[i] - axis.b[i]);
      axis.sigma.push_back(sigma_of(total, i));
    }
    axis.budget = shares_of(budget, zero);
    describe(axis, own.time_s[zero]);
    decide_agreement(axis, own.time_s[zero]);
    // Half of the variance of a change since the zero is the zero's: a constant, which moves no lag.
    const std::span<const UncertaintyShare> shares(axis.budget);
    const double sigma_a = total_sigma(shares.first(sources_of_a)) / std::numbers::sqrt2;
    const double sigma_b = total_sigma(shares.subspan(sources_of_a)) / std::numbers::sqrt2;
    const auto lag =
        clock_shift(axis.time_s, a_is_sparse ? axis.a : axis.b, dense.time_s, (a_is_sparse ? *axis_b : axis_a).value,
                    max_gap_s, a_is_sparse ? sigma_a : sigma_b, a_is_sparse ? sigma_b : sigma_a);
    if (lag) {
      axis.lag_s = a_is_sparse ? lag->shift_s : -lag->shift_s;
      axis.lag_sigma_s = lag->sigma_s;
    }
    result.axes.push_back(std::move(axis));
  }
  if (result.axes.empty()) throw Error(result.remarks.back());
  return result;
}

std::string conclusion(const Comparison& comparison) {
  std::vector<std::string> agree, unknown, deviations;
  for (const AxisComparison& axis : comparison.axes) {
    if (axis.agreement == Agreement::agrees) agree.push_back(axis.name);
    if (axis.agreement == Agreement::cannot_tell) unknown.push_back(axis.name);
    if (axis.agreement == Agreement::disagrees) deviations.push_back(sentence_of(axis));
  }
  std::string text;
  if (!deviations.empty()) {
    text = fmt::format("Beyond the stated uncertainty: {}.", fmt::join(deviations, "; "));
    if (!agree.empty()) text += fmt::format(" {} agree{}.", fmt::join(agree, ", "), agree.size() == 1 ? "s" : "");
  } else if (!agree.empty()) {
    text =
        fmt::format("{} agree{} within the stated uncertainty.", fmt::join(agree, ", "), agree.size() == 1 ? "s" : "");
  }
  if (!unknown.empty()) {
    text +=
        fmt::format("{}{}: cannot tell, no uncertainty is known.", text.empty() ? "" : " ", fmt::join(unknown, ", "));
  }
  return text;
}

}  // namespace ballbar

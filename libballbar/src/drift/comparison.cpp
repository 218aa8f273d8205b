#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

#include "ballbar/drift/compare.hpp"
#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/units.hpp"
#include "drift/clock_shift.hpp"
#include "drift/drift_methods.hpp"
#include "drift/sample_agreement.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

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
    side.budget.push_back({contribution.source, std::move(sigma), contribution.shared});
  }
  return side;
}

double rows_median(const std::vector<double>& values, std::size_t without) {
  std::vector<double> known;
  known.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i != without && std::isfinite(values[i])) known.push_back(values[i]);
  }
  return known.empty() ? 0.0 : median(std::move(known));
}

// Variances of a side apart: each row's own, and that of the zero, in every row: half of what is usual. What all rows
// share otherwise goes to `shared`.
struct Variances {
  std::vector<double> own;
  double reference = 0.0;
};

Variances variances_of(const Side& side, const DriftAxis& axis, const std::vector<Place>& places, std::size_t zero,
                       std::vector<std::vector<double>>& shared) {
  Variances variances{std::vector<double>(side.value.size(), 0.0)};
  for (std::size_t source = 0; source < side.budget.size(); ++source) {
    const Contribution& contribution = side.budget[source];
    std::vector<double> errors;
    errors.reserve(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double sigma = contribution.sigma[i];
      if (!contribution.shared) {
        if (!std::isnan(sigma)) variances.own[i] += sigma * sigma;
        continue;
      }
      // Linear in the value, and grown since the series' own zero.
      const double own = value_at(axis.budget[source].sigma, places[i]);
      errors.push_back(std::isnan(own) ? 0.0 : std::copysign(own, value_at(axis.value, places[i])));
    }
    if (!contribution.shared) continue;
    const double at_zero = errors[zero];
    for (double& error : errors) error -= at_zero;
    shared.push_back(std::move(errors));
  }
  variances.reference = 0.5 * rows_median(variances.own, zero);
  for (double& own : variances.own) own = std::max(own - variances.reference, 0.5 * own);
  return variances;
}

std::vector<UncertaintyShare> shares_of(const std::vector<Contribution>& budget, std::size_t zero,
                                        const std::string& unit) {
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
    shares.push_back({contribution.source, std::sqrt(variance), variance, unit});
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
      result.remarks.emplace_back(messages::not_compared(axis_a.name, own.time_s.size()));
      continue;
    }
    const std::size_t zero = reference_index(own.time_s, options.reference_s);
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
    DifferenceRows rows{own.time_s, side_a.value, side_b.value, zero, {}, {}, 0.0, 0.0, {}, true, axis_a.unit};
    Variances of_a = variances_of(side_a, axis_a, a_is_sparse ? own.sparse : own.dense, zero, rows.shared);
    Variances of_b = variances_of(side_b, *axis_b, a_is_sparse ? own.dense : own.sparse, zero, rows.shared);
    rows.variance_a = std::move(of_a.own);
    rows.variance_b = std::move(of_b.own);
    rows.reference_variance_a = of_a.reference;
    rows.reference_variance_b = of_b.reference;
    rows.stated = of_a.reference + of_b.reference > 0.0;
    std::vector<Contribution> budget = std::move(side_a.budget);
    std::move(side_b.budget.begin(), side_b.budget.end(), std::back_inserter(budget));

    for (const auto& [side, what, other] :
         {std::tuple(&axis_a, &a.what, &b.what), std::tuple(axis_b, &b.what, &a.what)}) {
      if (!side->budget.empty() || budget.empty()) continue;
      result.remarks.emplace_back(messages::no_uncertainty_stated(*what, side->name, *other));
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
    axis.budget = shares_of(budget, zero, axis.unit);
    describe_samples(axis, own.time_s[zero]);
    decide_by_samples(axis, own.time_s[zero]);
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
    axis.structure = difference_structure(rows);
    result.axes.push_back(std::move(axis));
  }
  if (result.axes.empty()) throw Error(text_of(result.remarks.back()));
  const auto tested = static_cast<std::size_t>(std::count_if(
      result.axes.begin(), result.axes.end(), [](const AxisComparison& axis) { return axis.structure.has_value(); }));
  for (AxisComparison& axis : result.axes) {
    if (!axis.structure) continue;
    axis.structure = judged(*axis.structure, tested);
    if (axis.structure->stands_out) axis.agreement = Agreement::disagrees;
  }
  return result;
}

std::optional<CommonLag> common_lag(const Comparison& comparison) {
  constexpr double kMostSigmas = 3.0;
  const auto alone = [](const AxisComparison& axis, DifferenceKind kind) {
    return axis.structure ? axis.structure->alone[static_cast<std::size_t>(kind)] : std::nullopt;
  };
  CommonLag common;
  double weight = 0.0;
  bool stands_out = false;
  for (const AxisComparison& axis : comparison.axes) {
    stands_out = stands_out || (axis.structure && axis.structure->stands_out);
    if (!axis.lag_s || !(*axis.lag_sigma_s > 0.0)) continue;
    const auto gain = alone(axis, DifferenceKind::gain), lag = alone(axis, DifferenceKind::lag);
    if (gain && gain->named && (!lag || lag->explains < gain->explains)) return std::nullopt;
    const double of_axis = 1.0 / (*axis.lag_sigma_s * *axis.lag_sigma_s);
    common.lag_s += of_axis * *axis.lag_s;
    weight += of_axis;
    common.axes.push_back(axis.name);
  }
  if (!stands_out || common.axes.size() < 2) return std::nullopt;
  common.lag_s /= weight;
  common.sigma_s = 1.0 / std::sqrt(weight);
  const bool same = std::all_of(comparison.axes.begin(), comparison.axes.end(), [&](const AxisComparison& axis) {
    return !axis.lag_s || std::abs(*axis.lag_s - common.lag_s) <= kMostSigmas * *axis.lag_sigma_s;
  });
  return same && std::abs(common.lag_s) > kMostSigmas * common.sigma_s ? std::optional(common) : std::nullopt;
}

}  // namespace ballbar

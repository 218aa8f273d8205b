#include "diagnosis/verdict/fitted_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "ballbar/internal/numerics/range.hpp"
#include "diagnosis/evidence/shape_fit.hpp"
#include "model/model_rows.hpp"

namespace ballbar {
namespace {

constexpr double k95 = 1.959964;
constexpr double kFall = 0.5 * k95 * k95;  // fall of ln of the likelihood at the ends of an interval
constexpr int kMostTries = 6;              // for an end

Model with_set(const Problem& problem, const EffectSet& set) {
  Model model = problem.model;
  if (set.freed) {
    const std::size_t parameter = problem.held[*set.freed].parameter;
    const std::size_t t = problem.base_model->term_of(parameter);
    model.terms[t].settings[parameter - static_cast<std::size_t>(problem.base_model->rows().offset(t))].held = false;
  }
  for (const std::size_t i : set.signatures) {
    const Signature& one = problem.library.signatures[i];
    const BoundEffect& bound = problem.library.families[one.family].bound;
    Term term = term_of(problem, bound);
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      if (bound.effect->parameters[k].kind == ParameterKind::gain) continue;
      term.settings[k].start = one.point[k];
      term.settings[k].stated = true;
    }
    model.terms.push_back(std::move(term));
  }
  return model;
}

// Starts with eight digits. An effect whose start alone distinguishes it from another one, such as the second of two
// cycles of nearly the same period, has as many digits as make them differ. Where no digits do, the start moves by the
// least amount that does: a model holds each effect once.
void begin_beside(Term& term, std::span<const Term> others, std::span<const double> values) {
  const auto is_there = [&] {
    const std::string label = label_of(term);
    return std::any_of(others.begin(), others.end(), [&](const Term& other) { return label_of(other) == label; });
  };
  const auto begin = [&](auto start_of) {
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      Setting& setting = term.settings[k];
      if (term.effect->parameters[k].kind == ParameterKind::gain) continue;
      setting.start = std::clamp(start_of(values[k]), setting.lower, setting.upper);
    }
    return !is_there();
  };
  for (int digits = 8; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    if (begin([&](double value) { return std::stod(fmt::format("{:.{}g}", value, digits)); })) return;
  }
  for (const double towards : {std::numeric_limits<double>::infinity(), 0.0}) {
    if (begin([&](double value) { return std::nextafter(value, towards); })) return;
  }
}

// An end of the 95 % interval: where the profile likelihood has fallen by kFall. towards: a first guess.
double profile_end(const BaseModel& model, const ShapeFit& best, std::size_t parameter, double towards,
                   const Eigen::MatrixXd& open, const Whitening& filter, const KnownScatter& known, double degrees) {
  const double value = best.parameters[parameter];
  const Setting& setting = model.setting(parameter);
  const bool in_logarithm = value > 0.0 && towards > 0.0;
  const double step = in_logarithm ? std::log(towards / value) : towards - value;
  const auto at = [&](double factor) {
    const double there = in_logarithm ? value * std::exp(factor * step) : value + factor * step;
    return std::clamp(there, setting.lower, setting.upper);
  };
  // The fall is about quadratic in the distance: its root about linear.
  double factor = 1.0, low = 0.0, low_root = 0.0;
  std::vector<double> start = best.parameters;
  for (int tries = 0; tries < kMostTries; ++tries) {
    start[parameter] = at(factor);
    const ShapeFit now = shape_fit(model, start, {}, open, filter, known, {4, 1e-6}, parameter);
    const double fall =
        0.5 * (degrees + known.readings) *
        std::log((now.square + known.readings * known.variance) / (best.square + known.readings * known.variance));
    const double root = std::sqrt(std::max(0.0, fall) / kFall);
    if (std::abs(root - 1.0) < 0.04) break;
    const double slope = (root - low_root) / (factor - low);
    if (root < 1.0) {
      low = factor;
      low_root = root;
    }
    const double next =
        slope > 1e-3 ? (root < 1.0 ? factor : low) + (1.0 - (root < 1.0 ? root : low_root)) / slope : 3.0 * factor;
    if (at(next) == at(factor)) break;
    factor = std::clamp(next, 0.3 * factor, 3.0 * factor);
    if (root < 1.0) start = now.parameters;
  }
  return at(factor);
}

// The rows of the smallest and the largest value in the run where they differ most: each run has its own zero. Where a
// value lasts, the later of the two rows is the last one: at the row of a jump its moment counts as well as its size.
std::pair<Eigen::Index, Eigen::Index> extremes_in_a_run(const Problem& problem, const Eigen::VectorXd& curve) {
  const std::vector<RowRange> runs = problem.model.level == Level::series
                                         ? runs_of(problem.time_s)
                                         : std::vector<RowRange>{{0, problem.time_s.size()}};
  std::pair<Eigen::Index, Eigen::Index> widest{0, 0};
  for (const RowRange& run : runs) {
    const auto begin = static_cast<Eigen::Index>(run.begin), count = static_cast<Eigen::Index>(run.end) - begin;
    Eigen::Index low = 0, high = 0;
    curve.segment(begin, count).minCoeff(&low);
    curve.segment(begin, count).maxCoeff(&high);
    Eigen::Index& later = high > low ? high : low;
    for (Eigen::Index i = count - 1; i > later; --i) {
      if (curve[begin + i] == curve[begin + later]) later = i;
    }
    if (curve[begin + high] - curve[begin + low] > curve[widest.second] - curve[widest.first])
      widest = {begin + low, begin + high};
  }
  return widest;
}

}  // namespace

FittedSet fitted_set(const Problem& problem, const Posterior& posterior, const EffectSet& set, bool with_profiles) {
  const Linearisation& linearisation = posterior.linearisations[set.linearisation];
  const Whitening& filter = posterior.filters[set.filter].whitening;
  FittedSet result;
  result.model = with_set(problem, set);
  std::vector<double> start = linearisation.parameters;
  for (std::size_t t = problem.model.terms.size(); t < result.model.terms.size(); ++t) {
    for (const Setting& setting : result.model.terms[t].settings) start.push_back(setting.start);
  }
  const BaseModel model(result.model, problem.logged, problem.y, problem.base.row);
  const ShapeFit best = shape_fit(model, start, {}, linearisation.open, filter, problem.known);

  const BaseColumns columns = model.at(best.parameters);
  const LinearSolution solution = linear_solution(filter, linear_model_of(columns, linearisation.open), problem.known);
  const Eigen::MatrixXd covariance = solution.covariance();

  result.parameters.push_back({"constant", "constant_um", "um", best.parameters[0] + problem.centre_um});
  result.parameters.front().state = ParameterState::held;
  for (const Term& term : result.model.terms) {
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      const Parameter& parameter = term.effect->parameters[k];
      FittedParameter one{label_of(term), parameter.name, parameter.unit, best.parameters[result.parameters.size()]};
      one.kind = parameter.kind;
      one.shape_of = parameter.shape_of;
      one.state = ParameterState::held;
      one.sigma = std::numeric_limits<double>::quiet_NaN();
      result.parameters.push_back(std::move(one));
    }
  }
  result.intervals.assign(result.parameters.size(), {});  // of the constant as the others
  for (std::size_t k = 0; k < columns.columns.size(); ++k) {
    const BaseColumn& column = columns.columns[k];
    const auto at = static_cast<Eigen::Index>(k);
    FittedParameter& one = result.parameters[column.parameter];
    one.state = ParameterState::free;
    one.sigma = std::sqrt(covariance(at, at)) * column.scale;
    Interval& interval = result.intervals[column.parameter];
    const bool in_logarithm = column.kind == BaseColumn::Kind::shape && one.value > 0.0 && one.unit != "1";
    if (in_logarithm) {
      const double factor = std::exp(k95 * one.sigma / one.value);
      interval = {one.value / factor, one.value * factor};
    } else {
      interval = {one.value - k95 * one.sigma, one.value + k95 * one.sigma};
    }
  }
  // Intervals of the free parameters of the added effects, by the profile likelihood.
  const std::size_t first_added = problem.base_model->parameters();
  for (std::size_t k = first_added; k < result.parameters.size() && with_profiles; ++k) {
    if (result.parameters[k].state != ParameterState::free || !std::isfinite(result.parameters[k].sigma)) continue;
    Interval& interval = result.intervals[k];
    interval.low =
        profile_end(model, best, k, interval.low, linearisation.open, filter, problem.known, solution.degrees);
    interval.high =
        profile_end(model, best, k, interval.high, linearisation.open, filter, problem.known, solution.degrees);
  }
  // The readings do not determine an onset between two rows.
  const std::vector<double>& time_s = problem.time_s;
  const bool is_one_run = std::is_sorted(time_s.begin(), time_s.end());
  for (std::size_t k = first_added; k < result.parameters.size() && is_one_run; ++k) {
    if (result.parameters[k].state != ParameterState::free || result.parameters[k].shape_of != ShapeOf::onset) continue;
    const auto after = std::upper_bound(time_s.begin(), time_s.end(), result.parameters[k].value);
    Interval& interval = result.intervals[k];
    if (after != time_s.begin()) interval.low = std::min(interval.low, *(after - 1));
    if (after != time_s.end()) interval.high = std::max(interval.high, *after);
  }
  // The amplitude of each effect: its largest difference in a run, with sigma from the covariance of its columns there.
  const ModelRows& rows = model.rows();
  Eigen::VectorXd together = Eigen::VectorXd::Zero(problem.y.size());
  for (std::size_t t = problem.model.terms.size(); t < result.model.terms.size(); ++t) {
    const Eigen::VectorXd added = rows.term(t, best.parameters.data() + rows.offset(t), nullptr);
    together += added;
    const auto [low, high] = extremes_in_a_run(problem, added);
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(covariance.rows());
    for (std::size_t k = 0; k < columns.columns.size(); ++k) {
      const BaseColumn& column = columns.columns[k];
      if (column.kind == BaseColumn::Kind::constant || model.term_of(column.parameter) != t) continue;
      const auto at = static_cast<Eigen::Index>(k);
      slope[at] = columns.values(high, at) - columns.values(low, at);
    }
    result.amplitude_um.push_back(added[high] - added[low]);
    result.amplitude_sigma_um.push_back(std::sqrt(std::max(0.0, slope.dot(covariance * slope))));
  }
  // A fit of this model starts at these shapes. `model` refers to the terms, so that they change last.
  for (std::size_t t = problem.model.terms.size(); t < result.model.terms.size(); ++t) {
    Term& term = result.model.terms[t];
    begin_beside(term, {result.model.terms.data(), t},
                 std::span(best.parameters).subspan(static_cast<std::size_t>(rows.offset(t)), term.settings.size()));
  }
  const auto [low, high] = extremes_in_a_run(problem, together);
  result.together_um = together[high] - together[low];
  return result;
}

}  // namespace ballbar

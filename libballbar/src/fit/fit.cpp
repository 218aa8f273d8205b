#include "ballbar/fit/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/internal/series/far_readings.hpp"
#include "ballbar/message_catalogue.hpp"
#include "fit/fit_uncertainty.hpp"
#include "fit/inlier_rows.hpp"
#include "fit/irls_and_gls.hpp"
#include "fit/machine_error_fit.hpp"
#include "fit/multi_start.hpp"
#include "fit/series_cost.hpp"
#include "model/model_rows.hpp"
#include "model/resolved_periods.hpp"
#include "noise/whitening.hpp"
#include "numerics/median.hpp"
#include "numerics/not_finite.hpp"
#include "numerics/tukey.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestForNoise = 30;  // below, the residual is taken as white

Bounds bounds_of(const Model& model, const ModelRows& rows) {
  const Eigen::Index count = rows.parameters();
  Bounds bounds{Eigen::VectorXd::Constant(count, -kInfinite), Eigen::VectorXd::Constant(count, kInfinite),
                std::vector<bool>(static_cast<std::size_t>(count), false)};
  bounds.held[0] = model.constant_um.has_value() || model.level == Level::recording;
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    for (std::size_t k = 0; k < model.terms[t].settings.size(); ++k) {
      const Setting& setting = model.terms[t].settings[k];
      const Eigen::Index index = rows.offset(t) + static_cast<Eigen::Index>(k);
      bounds.lower[index] = setting.lower;
      bounds.upper[index] = setting.upper;
      bounds.held[static_cast<std::size_t>(index)] = setting.held;
    }
  }
  return bounds;
}

// A stated moment of an effect that may occur at several is refined to half a row about it, between two rows to the
// interval between them. Farther away a fit that lacks other effects would find another jump, and a diagnosis this one
// again.
Bounds refined_bounds(Bounds bounds, const Model& model, const ModelRows& rows, const std::vector<double>& time_s) {
  if (!std::is_sorted(time_s.begin(), time_s.end())) return bounds;  // several runs
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    const Term& term = model.terms[t];
    for (std::size_t k = 0; k < term.settings.size() && term.effect->rules.may_repeat; ++k) {
      const Setting& setting = term.settings[k];
      if (term.effect->parameters[k].shape_of != ShapeOf::onset || !setting.stated) continue;
      const auto index = rows.offset(t) + static_cast<Eigen::Index>(k);
      const auto [from, to] = std::equal_range(time_s.begin(), time_s.end(), setting.start);
      const double share = from == to ? 1.0 : 0.5;  // of the way to the rows before and after
      const auto towards = [&](double row_s) { return setting.start + share * (row_s - setting.start); };
      if (from != time_s.begin()) bounds.lower[index] = std::max(bounds.lower[index], towards(*(from - 1)));
      if (to != time_s.end()) bounds.upper[index] = std::min(bounds.upper[index], towards(*to));
    }
  }
  return bounds;
}

// `without`: rising.
std::vector<std::size_t> rows_with_value(const Column& target, const std::vector<std::size_t>& without) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < target.values.size(); ++row) {
    if (!std::isnan(target.values[row]) && !std::binary_search(without.begin(), without.end(), row))
      rows.push_back(row);
  }
  return rows;
}

// Sigma of the target at the rows; empty if the data have none, or if a row has none or 0 (the row of the reference is
// 0 by definition and gets the smallest of the others).
std::vector<double> stated_sigma_um(const Series& data, const std::string& target,
                                    const std::vector<std::size_t>& rows) {
  const std::string unit(unit_of(target));
  if (unit.empty()) return {};
  const std::string name = fmt::format("{}_sigma_{}", target.substr(0, target.size() - unit.size() - 1), unit);
  const Column* column = find_column(data, name);
  if (column == nullptr) return {};
  double smallest = kInfinite;
  for (const std::size_t row : rows) {
    if (column->values[row] > 0.0) smallest = std::min(smallest, column->values[row]);
  }
  if (!std::isfinite(smallest)) return {};
  std::vector<double> sigma_um;
  for (const std::size_t row : rows) {
    const double sigma = column->values[row];
    if (std::isnan(sigma)) return {};
    sigma_um.push_back(sigma > 0.0 ? sigma : smallest);
  }
  return sigma_um;
}

std::vector<FittedParameter> parameters_of(const Model& model, const Eigen::VectorXd& values) {
  std::vector<FittedParameter> parameters{
      {"constant", "constant_um", "um", values[0], kUnknown, {}, ParameterKind::gain}};
  Eigen::Index index = 1;
  for (const Term& term : model.terms) {
    for (const Parameter& parameter : term.effect->parameters) {
      parameters.push_back({label_of(term),
                            parameter.name,
                            parameter.unit,
                            values[index++],
                            kUnknown,
                            {},
                            parameter.kind,
                            parameter.shape_of});
    }
  }
  return parameters;
}

Eigen::VectorXd values_of(const std::vector<FittedParameter>& parameters) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k) values[static_cast<Eigen::Index>(k)] = parameters[k].value;
  return values;
}

// Whether all that is free are gains: of such a sum of squares the minimum is known exactly.
bool is_linear(const Model& model) {
  return std::all_of(model.terms.begin(), model.terms.end(), [](const Term& term) {
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      if (!term.settings[k].held && term.effect->parameters[k].kind != ParameterKind::gain) return false;
    }
    return true;
  });
}

// The search ends where the sum of squares is flat, which is up to 1e-3 sigma away from its minimum.
Minimum exact(const FitProblem& problem, const Weighting& weighting, Minimum found) {
  constexpr Stop kToTheEnd{20, 0.0};
  Minimum end = minimise(problem.rows, problem.target_um, weighting, problem.bounds, found.parameters, kToTheEnd);
  if (!(end.cost <= found.cost)) return found;
  end.converged = found.converged;
  return end;
}

}  // namespace

Fit fit(const Model& model, const Series& data, std::size_t target, const FitOptions& options) {
  expect_suits(model, data);
  if (options.among_all_errors && is_of_machine_errors(model, data)) {
    return fit_of_machine_errors(model, data, target, joint_error_fit(data, MachineErrorOptions{}));
  }
  Fit result;
  result.target = model.targets.at(target);
  const Column& column = *find_column(data, result.target);
  if (model.level == Level::series && !options.robust) result.set_aside = far_readings(column.values);
  result.row = rows_with_value(column, result.set_aside);
  if (result.row.size() < 3) {
    throw Error(fmt::format("expected at least 3 values of {}, found {}.", result.target, result.row.size()));
  }
  const auto n = static_cast<Eigen::Index>(result.row.size());
  for (const std::size_t row : result.row) {
    result.time_s.push_back(data.time_s[row]);
    result.measured_um.push_back(column.values[row]);
  }
  result.sigma_um = stated_sigma_um(data, result.target, result.row);
  const Eigen::VectorXd measured = Eigen::VectorXd::Map(result.measured_um.data(), n);

  const Model resolved = with_resolved_periods(model, highest_Hz(result.time_s));
  const ModelRows rows(resolved, data, result.row);
  const Bounds bounds = bounds_of(resolved, rows);
  const auto free = static_cast<std::size_t>(std::count(bounds.held.begin(), bounds.held.end(), false));
  const Bounds refined = refined_bounds(bounds, resolved, rows, result.time_s);
  const FitProblem problem{rows, measured, refined, free};
  Weighting plain{Eigen::VectorXd::Ones(n)};
  for (std::size_t i = 0; i < result.sigma_um.size(); ++i)
    plain.row[static_cast<Eigen::Index>(i)] /= result.sigma_um[i];
  SolvedFit best{best_of(problem, plain, starts(resolved, rows, measured, plain.row, options.starts)), plain, {}};
  if (options.robust) {
    best = reweighted(
        problem, [&](const auto&) { return plain; }, std::move(best));
  }
  std::size_t kept = result.row.size() - best.discounted.size();
  const bool with_noise = options.noise || (!options.white && kept >= kFewestForNoise && kept > 2 * free);
  bool misfit = false;
  if (options.noise) {
    result.noise = *options.noise;
    best.weighting = {Eigen::VectorXd::Ones(n), Whitening(result.noise, result.time_s, result.sigma_um)};
    best.minimum = best_of(problem, best.weighting, {best.minimum.parameters});
  } else if (with_noise) {
    WhitenedFit refitted = whitened(problem, result, best, options.robust);
    best = std::move(refitted.solved);
    result.noise = refitted.noise;
    misfit = refitted.misfit;
    kept = result.row.size() - best.discounted.size();
  }
  if (!options.robust && is_linear(resolved)) best.minimum = exact(problem, best.weighting, std::move(best.minimum));

  Eigen::MatrixXd jacobian;
  const Eigen::VectorXd predicted = rows.sum(best.minimum.parameters, &jacobian);
  const Eigen::VectorXd residual = measured - predicted;
  result.parameters = parameters_of(resolved, best.minimum.parameters);
  result.predicted_um = vector_of(predicted);
  result.residual_um = vector_of(residual);
  for (std::size_t t = 0; t < rows.terms(); ++t) {
    result.contribution_um.push_back(vector_of(rows.term(t, best.minimum.parameters.data() + rows.offset(t), nullptr)));
  }
  result.discounted = best.discounted;
  result.converged = best.minimum.converged;
  const std::vector<double> kept_um = without(result.residual_um, result.discounted);
  const std::vector<double> kept_sigma_um = without(result.sigma_um, result.discounted);
  const std::vector<double> kept_time_s = without(result.time_s, result.discounted);
  result.rmse_um = rms_of(kept_um);
  if (!with_noise) result.noise = white_noise(kept_um, kept_sigma_um, free);

  if (misfit) {
    Weighting counted = plain;
    for (const std::size_t row : result.discounted) counted.row[static_cast<Eigen::Index>(row)] = 0.0;
    add_uncertainty_under_noise(result, weighted(counted, jacobian), bounds, counted.row);
  } else {
    // The scatter of the residual, corrected for the number of parameters; never below the stated one.
    best.weighting.discount.resize(0);
    const double spent = std::max(1.0, static_cast<double>(kept) - static_cast<double>(free));
    double variance = with_noise ? 1.0 : 2.0 * best.minimum.cost / spent;
    if (options.robust) {
      const Eigen::VectorXd white = weighted(best.weighting, residual);
      variance = robust_variance(white, median_sigma(white), static_cast<double>(free));
    }
    if (!result.sigma_um.empty()) variance = std::max(1.0, variance);
    if (result.sigma_um.empty() && kept < free + kFewestLeft) variance = kUnknown;
    add_uncertainty(result, weighted(best.weighting, jacobian), bounds, variance);
  }
  result.jacobian = std::move(jacobian);
  result.n_effective = effective_samples(result.noise, kept_time_s, kept_sigma_um);
  std::vector<double> speed_rpm;
  const auto speed = std::find_if(data.columns.begin(), data.columns.end(),
                                  [](const Column& candidate) { return candidate.role == Role::speed; });
  if (speed != data.columns.end()) {
    for (const std::size_t row : result.row) speed_rpm.push_back(speed->values[row]);
  }
  result.floor = floor_of(kept_time_s, without(result.measured_um, result.discounted), kept_sigma_um,
                          without(speed_rpm, result.discounted), result.noise);
  if (misfit) {
    result.remarks.push_back(
        messages::fit_slow_residual(fmt::format("{:.0f}", result.noise.correlation_time_s / 60.0),
                                    options.robust ? messages::fit_robust() : messages::fit_least_squares()));
  }
  add_remarks(result, free);
  return result;
}

Prediction predict(const Model& model, const std::vector<FittedParameter>& parameters, const Series& data,
                   const Eigen::MatrixXd* covariance) {
  std::vector<std::size_t> all(data.time_s.size());
  for (std::size_t row = 0; row < all.size(); ++row) all[row] = row;
  const ModelRows rows(model, data, std::move(all));
  const Eigen::VectorXd values = values_of(parameters);
  if (values.size() != rows.parameters()) {
    throw Error(fmt::format("expected {} parameters of the model, found {}.", rows.parameters(), values.size()));
  }
  Prediction prediction;
  Eigen::MatrixXd jacobian;
  prediction.predicted_um = vector_of(rows.sum(values, covariance == nullptr ? nullptr : &jacobian));
  if (covariance != nullptr) {
    const auto variance_um2 = (jacobian * *covariance).cwiseProduct(jacobian).rowwise().sum();
    prediction.sigma_um = vector_of(variance_um2.cwiseMax(0.0).cwiseSqrt());
  }
  for (std::size_t t = 0; t < rows.terms(); ++t) {
    prediction.contribution_um.push_back(vector_of(rows.term(t, values.data() + rows.offset(t), nullptr)));
  }
  return prediction;
}

}  // namespace ballbar

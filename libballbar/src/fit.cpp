#include "ballbar/fit.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "ballbar/error.hpp"
#include "model_rows.hpp"
#include "series_cost.hpp"
#include "starts.hpp"

namespace ballbar {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kTukey = 4.685;
constexpr int kRobustRounds = 8;
constexpr int kNoiseRounds = 2;
constexpr std::size_t kFewestForNoise = 30;  // below, the residual is taken as white
constexpr double kWorseByWhitening = 1.5;    // rms: the slow part of the data was given up
constexpr double kNoInformation = 1e-11;     // eigenvalue of the scaled information, of the largest

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

std::vector<std::size_t> rows_with_value(const Column& target) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < target.values.size(); ++row) {
    if (!std::isnan(target.values[row])) rows.push_back(row);
  }
  return rows;
}

// Sigma of the target at the rows; empty where the data have none, or where a row has none or 0 (a reference's own
// row is 0 by definition: it gets the smallest of the others).
std::vector<double> stated_sigma_um(const Series& data, const std::string& target,
                                    const std::vector<std::size_t>& rows) {
  const std::string unit(unit_of(target));
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

double median_of_magnitudes(const Eigen::VectorXd& values) {
  std::vector<double> magnitude(static_cast<std::size_t>(values.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) magnitude[static_cast<std::size_t>(i)] = std::abs(values[i]);
  const auto middle = magnitude.begin() + static_cast<std::ptrdiff_t>(magnitude.size() / 2);
  std::nth_element(magnitude.begin(), middle, magnitude.end());
  return *middle;
}

double scale_of(const Eigen::VectorXd& residual) { return std::max(1.4826 * median_of_magnitudes(residual), 1e-12); }

// Square roots of Tukey's weights of weighted residuals.
Eigen::VectorXd tukey(const Eigen::VectorXd& residual) {
  const double scale = scale_of(residual);
  Eigen::VectorXd weight(residual.size());
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    const double u = residual[i] / (kTukey * scale);
    weight[i] = std::abs(u) < 1.0 ? 1.0 - u * u : 0.0;
  }
  return weight;
}

// Variance of an M-estimate for (J'J)^-1 without its weights: n^2 / (n - p) sum psi^2 / (sum psi')^2 (Huber 1981).
double robust_variance(const Eigen::VectorXd& residual, std::size_t free) {
  const double scale = scale_of(residual);
  double psi2 = 0.0, slope = 0.0;
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    const double u2 = std::pow(residual[i] / (kTukey * scale), 2);
    if (u2 >= 1.0) continue;
    psi2 += std::pow(residual[i] * (1.0 - u2) * (1.0 - u2), 2);
    slope += (1.0 - u2) * (1.0 - 5.0 * u2);
  }
  const auto n = static_cast<double>(residual.size());
  return n * n / std::max(1.0, n - static_cast<double>(free)) * psi2 / (slope * slope);
}

struct Solved {
  Minimum minimum;
  Weighting weighting;
  std::size_t discounted = 0;
};

// A few steps from every start, then to the end from the best of them.
Minimum best_of(const ModelRows& rows, const Eigen::VectorXd& target, const Weighting& weighting, const Bounds& bounds,
                const std::vector<Eigen::VectorXd>& starts) {
  constexpr int kFewSteps = 12;
  Minimum best;
  best.cost = kInfinite;
  for (const Eigen::VectorXd& start : starts) {
    Minimum now = minimise(rows, target, weighting, bounds, start, kFewSteps);
    if (now.cost < best.cost) best = std::move(now);
  }
  if (std::isinf(best.cost)) {
    throw Error(
        "expected a model with finite values near its start, found none: the numbers in it or in the data are too "
        "large.");
  }
  return best.converged ? best : minimise(rows, target, weighting, bounds, best.parameters);
}

Solved solved(const ModelRows& rows, const Eigen::VectorXd& target, const Weighting& weighting, const Bounds& bounds,
              const std::vector<Eigen::VectorXd>& starts, bool robust) {
  Solved result{best_of(rows, target, weighting, bounds, starts), weighting, 0};
  if (!robust) return result;
  for (int round = 0; round < kRobustRounds; ++round) {
    const Eigen::VectorXd residual = target - rows.sum(result.minimum.parameters, nullptr);
    const Eigen::VectorXd discount = tukey(residual.cwiseProduct(weighting.row));
    result.weighting.row = weighting.row.cwiseProduct(discount);
    result.discounted = static_cast<std::size_t>((discount.array() < 0.1).count());
    result.minimum = minimise(rows, target, result.weighting, bounds, result.minimum.parameters);
  }
  return result;
}

bool on_bound(double value, double bound, double start) {
  return std::isfinite(bound) && std::abs(value - bound) <= 1e-6 * std::max({std::abs(bound), std::abs(start), 1e-6});
}

// A memory longer than a tenth of the record is no noise that the record could show: it is what the model lacks. To
// whiten it would difference the data and fit the fast part alone.
bool is_misfit(const Noise& noise, const std::vector<double>& time_s) {
  return noise.correlated_um > noise.white_um && noise.correlation_time_s > 0.1 * (time_s.back() - time_s.front());
}

// W C W x for the covariance C of the noise and the weights W: the exponential part by two recursions, O(n).
Eigen::MatrixXd noise_times(const Fit& result, const Weighting& weighting, const Eigen::MatrixXd& columns) {
  const Eigen::Index n = columns.rows();
  const Noise& noise = result.noise;
  Eigen::MatrixXd x = weighting.row.asDiagonal() * columns;
  Eigen::MatrixXd out(n, columns.cols());
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(columns.cols());
  const auto decay = [&](Eigen::Index i) {
    const auto row = static_cast<std::size_t>(i);
    return std::exp(-(result.time_s[row] - result.time_s[row - 1]) / noise.correlation_time_s);
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i > 0) sum = decay(i) * (sum + x.row(i - 1));
    out.row(i) = sum + x.row(i);
  }
  sum.setZero();
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    if (i + 1 < n) sum = decay(i + 1) * (sum + x.row(i + 1));
    out.row(i) += sum;
  }
  out *= noise.correlated_um * noise.correlated_um;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double sigma = result.sigma_um.empty() ? 0.0 : result.sigma_um[static_cast<std::size_t>(i)];
    out.row(i) += (noise.white_um * noise.white_um + sigma * sigma) * x.row(i);
  }
  return weighting.row.asDiagonal() * out;
}

// State, sigma and covariance of the parameters from the weighted Jacobian J at the minimum: variance (J'J)^-1, or
// where `noise` gives the covariance C of the weighted residuals, (J'J)^-1 J' C J (J'J)^-1.
void add_uncertainty(Fit& result, const Eigen::MatrixXd& jacobian, const Bounds& bounds, double variance,
                     const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& noise) {
  std::vector<Eigen::Index> used;
  for (std::size_t k = 0; k < result.parameters.size(); ++k) {
    FittedParameter& parameter = result.parameters[k];
    const auto index = static_cast<Eigen::Index>(k);
    parameter.sigma = kUnknown;
    if (bounds.held[k]) {
      parameter.state = ParameterState::held;
    } else if (on_bound(parameter.value, bounds.lower[index], parameter.value)) {
      parameter.state = ParameterState::on_lower_bound;
    } else if (on_bound(parameter.value, bounds.upper[index], parameter.value)) {
      parameter.state = ParameterState::on_upper_bound;
    } else {
      used.push_back(index);
    }
  }
  const auto count = static_cast<Eigen::Index>(result.parameters.size());
  result.covariance = Eigen::MatrixXd::Zero(count, count);
  if (used.empty()) return;
  const auto m = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd columns(jacobian.rows(), m);
  for (Eigen::Index j = 0; j < m; ++j) columns.col(j) = jacobian.col(used[static_cast<std::size_t>(j)]);
  const Eigen::VectorXd scale = columns.colwise().norm();
  const double largest = scale.maxCoeff();
  for (Eigen::Index j = 0; j < m; ++j) columns.col(j) /= scale[j] > 1e-14 * largest ? scale[j] : kInfinite;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(columns.transpose() * columns));
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd lost = Eigen::VectorXd::Zero(m);  // share of each parameter in directions without information
  for (Eigen::Index i = 0; i < m; ++i) {
    const Eigen::VectorXd direction = eigen.eigenvectors().col(i);
    if (eigen.eigenvalues()[i] > kNoInformation * eigen.eigenvalues()[m - 1]) {
      inverse += direction * direction.transpose() / eigen.eigenvalues()[i];
    } else {
      lost += direction.cwiseAbs2();
    }
  }
  if (noise) inverse = inverse * (columns.transpose() * noise(columns)) * inverse;
  for (Eigen::Index j = 0; j < m; ++j) {
    const Eigen::Index row = used[static_cast<std::size_t>(j)];
    FittedParameter& parameter = result.parameters[static_cast<std::size_t>(row)];
    if (lost[j] > 1e-6) {
      parameter.state = ParameterState::undetermined;
      parameter.sigma = kInfinite;
      continue;
    }
    for (Eigen::Index i = 0; i < m; ++i) {
      if (lost[i] > 1e-6) continue;
      const Eigen::Index column = used[static_cast<std::size_t>(i)];
      result.covariance(row, column) = variance * inverse(j, i) / (scale[j] * scale[i]);
    }
    parameter.sigma = std::sqrt(result.covariance(row, row));
  }
}

// An onset is known to the row, not better: at least the rms of being anywhere within a row of the truth.
void widen_onsets(Fit& result) {
  for (FittedParameter& parameter : result.parameters) {
    if (parameter.name != "onset_s" || parameter.state == ParameterState::held) continue;
    const auto after = std::lower_bound(result.time_s.begin(), result.time_s.end(), parameter.value);
    if (after == result.time_s.begin() || after == result.time_s.end()) continue;
    const double between_s = *after - *(after - 1);
    if (parameter.state == ParameterState::undetermined) parameter.sigma = 0.0;
    parameter.state = ParameterState::free;
    parameter.sigma = std::max(std::isnan(parameter.sigma) ? 0.0 : parameter.sigma, between_s / std::sqrt(3.0));
  }
}

std::vector<FittedParameter> parameters_of(const Model& model, const Eigen::VectorXd& values) {
  std::vector<FittedParameter> parameters{{"constant", "constant_um", "um", values[0], kUnknown, {}}};
  Eigen::Index index = 1;
  for (const Term& term : model.terms) {
    for (const Parameter& parameter : term.effect->parameters) {
      parameters.push_back({label_of(term), parameter.name, parameter.unit, values[index++], kUnknown, {}});
    }
  }
  return parameters;
}

Eigen::VectorXd values_of(const std::vector<FittedParameter>& parameters) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k) values[static_cast<Eigen::Index>(k)] = parameters[k].value;
  return values;
}

std::vector<double> vector_of(const Eigen::VectorXd& values) { return {values.data(), values.data() + values.size()}; }

void add_remarks(Fit& result, std::size_t free) {
  for (const FittedParameter& parameter : result.parameters) {
    const std::string name = fmt::format("{} of {}", parameter.name, parameter.effect);
    if (parameter.state == ParameterState::undetermined) {
      result.remarks.push_back(fmt::format("The data do not determine {}.", name));
    } else if (parameter.state == ParameterState::on_lower_bound || parameter.state == ParameterState::on_upper_bound) {
      result.remarks.push_back(fmt::format("{} came to rest on its {} bound {:g} {}: its sigma is not known.", name,
                                           parameter.state == ParameterState::on_lower_bound ? "lower" : "upper",
                                           parameter.value, parameter.unit));
    }
  }
  if (static_cast<double>(free) > result.n_effective) {
    result.remarks.push_back(
        fmt::format("{} free parameters for {:.1f} independent samples (of {}): too many for these data.", free,
                    result.n_effective, result.residual_um.size()));
  }
  if (3 * free > result.residual_um.size() && static_cast<double>(free) <= result.n_effective) {
    result.remarks.push_back(
        fmt::format("{} free parameters for {} values: fewer than three values for each, so that much "
                    "is fitted that is not there.",
                    free, result.residual_um.size()));
  }
  if (result.discounted > 0) {
    result.remarks.emplace_back(
        "A robust fit takes the noise as white. RMSE and misfit count the discounted values too.");
  }
  if (!result.converged) result.remarks.emplace_back("The fit did not converge; its parameters are the best it found.");
}

}  // namespace

Fit fit(const Model& model, const Series& data, std::size_t target, const FitOptions& options) {
  expect_suits(model, data);
  Fit result;
  result.target = model.targets.at(target);
  const Column& column = *find_column(data, result.target);
  result.row = rows_with_value(column);
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

  const ModelRows rows(model, data, result.row);
  const Bounds bounds = bounds_of(model, rows);
  const auto free = static_cast<std::size_t>(std::count(bounds.held.begin(), bounds.held.end(), false));
  Weighting weighting{Eigen::VectorXd::Ones(n), std::nullopt};
  for (std::size_t i = 0; i < result.sigma_um.size(); ++i)
    weighting.row[static_cast<Eigen::Index>(i)] /= result.sigma_um[i];
  const std::vector<Eigen::VectorXd> from = starts(model, rows, measured, weighting.row, options.starts);
  Solved best = solved(rows, measured, weighting, bounds, from, options.robust);

  const auto residual_at = [&](const Eigen::VectorXd& p) { return Eigen::VectorXd(measured - rows.sum(p, nullptr)); };
  const auto jacobian_at = [&](const Eigen::VectorXd& p) {
    Eigen::MatrixXd all;
    rows.sum(p, &all);
    Eigen::MatrixXd spent(n, static_cast<Eigen::Index>(free));
    Eigen::Index used = 0;
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      if (!bounds.held[static_cast<std::size_t>(k)]) spent.col(used++) = all.col(k);
    }
    return spent;
  };
  Eigen::VectorXd residual = residual_at(best.minimum.parameters);
  const bool with_noise = options.noise || (!options.white && !options.robust && result.row.size() >= kFewestForNoise &&
                                            result.row.size() > 2 * free);
  bool misfit = false;
  if (options.noise) {
    result.noise = *options.noise;
    const Weighting known{Eigen::VectorXd::Ones(n), Whitening(result.noise, result.time_s, result.sigma_um)};
    best = solved(rows, measured, known, bounds, from, options.robust);
    residual = residual_at(best.minimum.parameters);
  } else if (with_noise) {
    const Solved least_squares = best;
    for (int round = 0; round < kNoiseRounds; ++round) {
      // The last time with the parameters that the fit has spent (REML).
      const bool last = round + 1 == kNoiseRounds;
      result.noise = noise_of(result.time_s, vector_of(residual), result.sigma_um,
                              last ? jacobian_at(best.minimum.parameters) : Eigen::MatrixXd());
      misfit = round == 0 && is_misfit(result.noise, result.time_s);
      if (misfit) break;
      Weighting white{Eigen::VectorXd::Ones(n), Whitening(result.noise, result.time_s, result.sigma_um)};
      Solved whitened = solved(rows, measured, white, bounds, {best.minimum.parameters}, options.robust);
      const Eigen::VectorXd left = residual_at(whitened.minimum.parameters);
      misfit = left.norm() > kWorseByWhitening * residual.norm();
      if (misfit) {
        best = least_squares;
        residual = residual_at(best.minimum.parameters);
        result.noise = noise_of(result.time_s, vector_of(residual), result.sigma_um);
        break;
      }
      best = std::move(whitened);
      residual = left;
    }
  } else {
    const double variance = residual.squaredNorm() / std::max(1.0, static_cast<double>(n) - static_cast<double>(free));
    result.noise.white_um = std::sqrt(variance);
    if (!result.sigma_um.empty()) {
      double stated = 0.0;
      for (const double sigma : result.sigma_um) stated += sigma * sigma / static_cast<double>(n);
      result.noise.white_um = std::sqrt(std::max(0.0, variance - stated));
    }
  }

  Eigen::MatrixXd jacobian;
  const Eigen::VectorXd predicted = rows.sum(best.minimum.parameters, &jacobian);
  result.parameters = parameters_of(model, best.minimum.parameters);
  result.predicted_um = vector_of(predicted);
  result.residual_um = vector_of(residual);
  for (std::size_t t = 0; t < rows.terms(); ++t) {
    result.contribution_um.push_back(vector_of(rows.term(t, best.minimum.parameters.data() + rows.offset(t), nullptr)));
  }
  result.rmse_um = std::sqrt(residual.squaredNorm() / static_cast<double>(n));
  result.converged = best.minimum.converged;
  result.discounted = best.discounted;
  // The scatter that is left, for the parameters spent; never below what was stated.
  const double spent =
      std::max(1.0, static_cast<double>(n - static_cast<Eigen::Index>(result.discounted)) - static_cast<double>(free));
  double variance = with_noise ? 1.0 : 2.0 * best.minimum.cost / spent;
  if (options.robust) {
    best.weighting.row = weighting.row;
    variance = robust_variance(residual.cwiseProduct(weighting.row), free);
  }
  if (!result.sigma_um.empty() && !with_noise) variance = std::max(1.0, variance);
  if (misfit) {
    add_uncertainty(result, weighted(best.weighting, jacobian), bounds, 1.0,
                    [&](const Eigen::MatrixXd& columns) { return noise_times(result, best.weighting, columns); });
  } else {
    add_uncertainty(result, weighted(best.weighting, jacobian), bounds, variance, nullptr);
  }
  result.jacobian = std::move(jacobian);
  result.n_effective = effective_samples(result.noise, result.time_s, result.sigma_um);
  widen_onsets(result);
  std::vector<double> speed_rpm;
  const auto speed = std::find_if(data.columns.begin(), data.columns.end(),
                                  [](const Column& candidate) { return candidate.role == Role::speed; });
  if (speed != data.columns.end()) {
    for (const std::size_t row : result.row) speed_rpm.push_back(speed->values[row]);
  }
  result.floor = floor_of(result.time_s, result.measured_um, result.sigma_um, speed_rpm, result.noise);
  if (misfit) {
    result.remarks.push_back(
        fmt::format("The residual has a memory of {:.0f} min. It is taken as what the model lacks rather than noise: "
                    "the parameters "
                    "are those of least squares, their sigma is widened for that memory.",
                    result.noise.correlation_time_s / 60.0));
  }
  add_remarks(result, free);
  return result;
}

Prediction predict(const Model& model, const std::vector<FittedParameter>& parameters, const Series& data) {
  std::vector<std::size_t> all(data.time_s.size());
  for (std::size_t row = 0; row < all.size(); ++row) all[row] = row;
  const ModelRows rows(model, data, std::move(all));
  const Eigen::VectorXd values = values_of(parameters);
  if (values.size() != rows.parameters()) {
    throw Error(fmt::format("expected {} parameters of the model, found {}.", rows.parameters(), values.size()));
  }
  Prediction prediction;
  prediction.predicted_um = vector_of(rows.sum(values, nullptr));
  for (std::size_t t = 0; t < rows.terms(); ++t) {
    prediction.contribution_um.push_back(vector_of(rows.term(t, values.data() + rows.offset(t), nullptr)));
  }
  return prediction;
}

}  // namespace ballbar

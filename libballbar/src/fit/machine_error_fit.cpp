#include "fit/machine_error_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ballbar/circle/recording.hpp"
#include "ballbar/message_catalogue.hpp"
#include "model/model_rows.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestReadings = 120;  // readings of a recording

bool is_error(const Term& term) {
  if (term.effect->rules.error_fit == ErrorFit::none) return false;
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    if (term.settings[k].held && term.effect->parameters[k].kind == ParameterKind::gain) return false;
  }
  return true;
}

// Index of the first parameter of each term in the model; 0 is the constant.
Eigen::Index offset_of(const Model& model, std::size_t term) {
  Eigen::Index offset = 1;
  for (std::size_t t = 0; t < term; ++t) offset += static_cast<Eigen::Index>(model.terms[t].settings.size());
  return offset;
}

// The value of a gain as a linear combination of the fit's gains; the mean for separate gains of recordings.
Eigen::RowVectorXd sum_of(const JointErrorFit& errors, const Effect& effect, std::size_t gain) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(errors.gains.size());
  for (std::size_t k = 0; k < errors.columns().size(); ++k) {
    const ErrorColumn& column = errors.columns()[k];
    if (column.effect == &effect && column.gain == gain) sum[static_cast<Eigen::Index>(k)] = 1.0;
  }
  return sum.sum() > 0.0 ? Eigen::RowVectorXd(sum / sum.sum()) : sum;
}

double shape_of(const JointErrorFit& errors, const Term& term, std::size_t parameter) {
  const Setting& setting = term.settings[parameter];
  const bool is_fitted = !setting.stated && parameter == shape_of(*term.effect);  // as errors fits it
  if (setting.held && !is_fitted) return setting.start;
  for (const FittedEffect& effect : errors.design.effects) {
    if (effect.effect == term.effect.get() && effect.shape) return *effect.shape;
  }
  return term.settings[parameter].start;
}

// Free gains of the circles, as columns of the whole Jacobian.
std::vector<Eigen::Index> circle_gains(const Model& model) {
  std::vector<Eigen::Index> gains;
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    const Term& term = model.terms[t];
    if (!term.effect->rules.is_base) continue;
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      if (!term.settings[k].held) gains.push_back(offset_of(model, t) + static_cast<Eigen::Index>(k));
    }
  }
  return gains;
}

std::vector<double> as_vector(const Eigen::VectorXd& values) { return {values.begin(), values.end()}; }

}  // namespace

bool is_of_machine_errors(const Model& model, const Series& data) {
  if (model.level != Level::recording || model.targets.size() != 1 || model.targets.front() != "deviation_um")
    return false;
  const Column* linear = find_column(data, trace_column("linear_axes"));
  if (linear == nullptr) return false;
  const auto all_are = [&](std::string_view role) {
    const std::vector<double>& values = find_column(data, trace_column(role))->values;
    return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
  };
  if (!all_are("linear_axes") || linear->values.front() != 1.0 || !all_are("radius")) return false;
  const std::vector<double>& recording = find_column(data, trace_column("recording"))->values;
  for (double number = 0.0; number <= recording.back(); number += 1.0) {
    if (static_cast<std::size_t>(std::count(recording.begin(), recording.end(), number)) < kFewestReadings)
      return false;
  }
  if (longest_arc_rad(data) < kShortestArc_rad) return false;
  return std::all_of(model.terms.begin(), model.terms.end(),
                     [](const Term& term) { return term.effect->rules.is_base || is_error(term); });
}

Fit fit_of_machine_errors(const Model& model, const Series& data, std::size_t target, const JointErrorFit& errors) {
  Fit result;
  result.target = model.targets.at(target);
  result.time_s = data.time_s;
  result.measured_um = find_column(data, result.target)->values;
  const auto n = static_cast<Eigen::Index>(result.measured_um.size());
  result.row.resize(result.measured_um.size());
  for (std::size_t i = 0; i < result.row.size(); ++i) result.row[i] = i;
  const Eigen::VectorXd measured = Eigen::VectorXd::Map(result.measured_um.data(), n);
  const ModelRows rows(model, data, result.row);

  // The errors from the joint fit.
  Eigen::VectorXd values = Eigen::VectorXd::Zero(rows.parameters());
  Eigen::MatrixXd of_gains = Eigen::MatrixXd::Zero(rows.parameters(), errors.gains.size());
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    const Term& term = model.terms[t];
    std::size_t gain = 0;
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      const Eigen::Index at = rows.offset(t) + static_cast<Eigen::Index>(k);
      if (term.effect->rules.is_base) {
        values[at] = term.settings[k].held ? term.settings[k].start : 0.0;
      } else if (term.effect->parameters[k].kind == ParameterKind::shape) {
        values[at] = shape_of(errors, term, k);
      } else {
        of_gains.row(at) = sum_of(errors, *term.effect, gain++);
        values[at] = of_gains.row(at) * errors.gains;
      }
    }
  }
  result.covariance = of_gains * errors.covariance * of_gains.transpose();

  // The circles by least squares on the residual of the errors; the length equation is nearly linear in them.
  const std::vector<Eigen::Index> circles = circle_gains(model);
  for (int step = 0; step < 2 && !circles.empty(); ++step) {
    const Eigen::VectorXd left = measured - rows.sum(values, &result.jacobian);
    const Eigen::MatrixXd columns = result.jacobian(Eigen::all, circles);
    const Eigen::MatrixXd inverse =
        (columns.transpose() * columns).llt().solve(Eigen::MatrixXd::Identity(columns.cols(), columns.cols()));
    values(circles) += inverse * (columns.transpose() * left);
    Eigen::MatrixXd weighted(errors.rows.size(), columns.cols());
    std::vector<double> of_fine(errors.rows.row_of.size());
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
      std::fill(of_fine.begin(), of_fine.end(), 0.0);
      for (Eigen::Index i = 0; i < n; ++i) of_fine[errors.rows.fine_of[static_cast<std::size_t>(i)]] += columns(i, k);
      for (std::size_t i = 0; i < of_fine.size(); ++i)
        of_fine[i] /= errors.rows.fine_count[static_cast<Eigen::Index>(i)];
      weighted.col(k) = errors.rows.count.cwiseProduct(errors.rows.mean(of_fine));
    }
    result.covariance(circles, circles) = inverse * scatter_of(weighted, errors.rows, errors.noise) * inverse;
  }
  const Eigen::VectorXd predicted = rows.sum(values, &result.jacobian);
  const Eigen::VectorXd residual = measured - predicted;
  result.predicted_um = as_vector(predicted);
  result.residual_um = as_vector(residual);
  for (std::size_t t = 0; t < rows.terms(); ++t) {
    result.contribution_um.push_back(as_vector(rows.term(t, values.data() + rows.offset(t), nullptr)));
  }
  constexpr double kHeld = std::numeric_limits<double>::quiet_NaN();
  result.parameters.push_back({"constant", "constant_um", "um", 0.0, kHeld, ParameterState::held, ParameterKind::gain});
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    const Term& term = model.terms[t];
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      const Eigen::Index at = rows.offset(t) + static_cast<Eigen::Index>(k);
      const Parameter& parameter = term.effect->parameters[k];
      const bool is_free = !term.settings[k].held && parameter.kind == ParameterKind::gain;
      const double sigma = is_free ? std::sqrt(std::max(0.0, result.covariance(at, at))) : kHeld;
      result.parameters.push_back({label_of(term), parameter.name, parameter.unit, values[at], sigma,
                                   is_free ? ParameterState::free : ParameterState::held, parameter.kind,
                                   parameter.shape_of});
    }
  }
  result.noise = errors.noise.front().noise;
  result.rmse_um = std::sqrt(residual.squaredNorm() / static_cast<double>(n));
  result.floor = {errors.rms_um(errors.residual()), messages::noise_of_errors()};
  result.n_effective = effective_samples(result.noise, result.time_s, {});
  result.converged = true;
  return result;
}

}  // namespace ballbar

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "noise/whitening.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kTurn = 0.2;  // of the span

// For each row whether the curve rises on its way to the next turn: a turn is a change of direction by more than kTurn
// of the span.
std::vector<char> rises(const std::vector<double>& curve) {
  const double turn = kTurn * range_of(curve);
  std::vector<char> result(curve.size(), 1);
  std::size_t low = 0, high = 0, from = 0;
  int way = 0;  // not known yet
  const auto fill = [&](std::size_t to, bool is_rising) {
    std::fill(result.begin() + static_cast<long>(from), result.begin() + static_cast<long>(to), is_rising ? 1 : 0);
    from = to;
  };
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve[i] < curve[low]) low = i;
    if (curve[i] > curve[high]) high = i;
    if (way >= 0 && curve[i] < curve[high] - turn) {
      if (way == 0 && high > 0) fill(high + 1, true);
      if (way > 0) fill(high + 1, true);
      way = -1;
      low = i;
    } else if (way <= 0 && curve[i] > curve[low] + turn) {
      if (way == 0 && low > 0) fill(low + 1, false);
      if (way < 0) fill(low + 1, false);
      way = 1;
      high = i;
    }
  }
  fill(curve.size(), way >= 0);
  return result;
}

// The part of the curve that comes from its rising rows, and from the others.
Eigen::MatrixXd split(const std::vector<double>& curve) {
  const std::vector<char> up = rises(curve);
  Eigen::MatrixXd parts(static_cast<Eigen::Index>(curve.size()), 2);
  parts.row(0) << curve[0], 0.0;
  for (Eigen::Index i = 1; i < parts.rows(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    parts.row(i) = parts.row(i - 1);
    parts(i, up[row] != 0 ? 0 : 1) += curve[row] - curve[row - 1];
  }
  return parts;
}

void fit_apart(Coefficient& coefficient, const Fit& fit, std::size_t gain) {
  const auto at = static_cast<Eigen::Index>(gain);
  const Eigen::VectorXd unit = fit.jacobian.col(at);
  const Eigen::MatrixXd parts = split({unit.data(), unit.data() + unit.size()});
  const auto span = [](const Eigen::VectorXd& part) { return part.maxCoeff() - part.minCoeff(); };
  if (std::min(span(parts.col(0)), span(parts.col(1))) < kTurn * span(unit)) return;
  Eigen::MatrixXd columns(unit.size(), 3);
  columns << parts, Eigen::VectorXd::Map(fit.residual_um.data(), unit.size()) + coefficient.value.value_um * unit;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    if (k == gain || fit.parameters[k].state != ParameterState::free) continue;
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    columns.col(columns.cols() - 1) = fit.jacobian.col(static_cast<Eigen::Index>(k));
  }
  columns.col(2).swap(columns.col(columns.cols() - 1));  // what they explain, last
  const Eigen::MatrixXd white = whitened(Whitening(fit.noise, fit.time_s, fit.sigma_um, fit.discounted), columns);
  const Eigen::MatrixXd x = white.leftCols(white.cols() - 1);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> normal(x.transpose() * x);
  if (normal.rank() < x.cols()) return;
  const Eigen::VectorXd values = normal.solve(x.transpose() * white.rightCols(1));
  const Eigen::MatrixXd covariance = normal.inverse();
  const auto estimate = [&](Eigen::Index k) { return Estimate{values[k], std::sqrt(std::max(0.0, covariance(k, k)))}; };
  coefficient.rising = estimate(0);
  coefficient.falling = estimate(1);
}

}  // namespace

std::vector<Coefficient> coefficients_of(const Model& model, const Fit& fit, const Series& data) {
  std::vector<Coefficient> all;
  for (std::size_t k = 0; k < model.terms.size(); ++k) {
    const Term& term = model.terms[k];
    const auto is_gain = [](const Parameter& one) { return one.kind == ParameterKind::gain; };
    const std::vector<Parameter>& parameters = term.effect->parameters;
    if (term.columns.size() != 1 || std::count_if(parameters.begin(), parameters.end(), is_gain) != 1) continue;
    const Parameter& gain = *std::find_if(parameters.begin(), parameters.end(), is_gain);
    const std::string label = label_of(term);
    const auto fitted = std::find_if(fit.parameters.begin(), fit.parameters.end(), [&](const FittedParameter& one) {
      return one.effect == label && one.name == gain.name;
    });
    const Column* column = find_column(data, term.columns.front());
    if (gain.unit != "um/K" || fitted == fit.parameters.end() || column == nullptr) continue;
    std::vector<double> values;
    values.reserve(fit.row.size());
    for (const std::size_t row : fit.row) {
      if (std::isfinite(column->values[row])) values.push_back(column->values[row]);
    }
    Coefficient one;
    one.effect = label;
    one.column = term.columns.front();
    one.unit = gain.unit;
    one.value = {fitted->value, fitted->state == ParameterState::free ? fitted->sigma : kUnknown};
    one.span_K = range_of(values);
    one.size_um = range_of(fit.contribution_um[k]);
    one.usual_low = gain.usual_low, one.usual_high = gain.usual_high, one.usual = gain.usual;
    if (fitted->state == ParameterState::free)
      fit_apart(one, fit, static_cast<std::size_t>(fitted - fit.parameters.begin()));
    all.push_back(std::move(one));
  }
  return all;
}

bool is_usual(const Coefficient& coefficient) {
  const double size = std::abs(coefficient.value.value_um);
  const double slack = std::isfinite(coefficient.value.sigma_um) ? 2.0 * coefficient.value.sigma_um : 0.0;
  return coefficient.usual.empty() || (size + slack >= coefficient.usual_low && size - slack <= coefficient.usual_high);
}

}  // namespace ballbar

#include "scatter.hpp"

#include <Eigen/QR>
#include <cmath>

namespace ballbar::verdicts {

double rounded(double value, double step) { return step > 0.0 ? step * std::round(value / step) : value; }

std::vector<double> drawn(const Scatter& scatter, const std::vector<double>& time_s, Chance& chance) {
  std::vector<double> values;
  values.reserve(time_s.size());
  double state = chance.normal();
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (i > 0) {
      const double phi = std::exp(-(time_s[i] - time_s[i - 1]) / scatter.time_constant_s);
      state = phi * state + std::sqrt(1.0 - phi * phi) * (scatter.heavy ? chance.student4() : chance.normal());
    }
    values.push_back(scatter.sigma_um * state + scatter.white_um * chance.normal());
  }
  return values;
}

Eigen::MatrixXd whitened(const Eigen::MatrixXd& columns, const std::vector<double>& time_s, const Scatter& scatter) {
  const double variance = scatter.sigma_um * scatter.sigma_um;
  const double white =
      scatter.white_um * scatter.white_um + scatter.resolution_um * scatter.resolution_um / 12.0;  // um^2
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(columns.cols());
  double p = variance;
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    if (i > 0) {
      const auto at = static_cast<std::size_t>(i);
      const double phi = std::exp(-(time_s[at] - time_s[at - 1]) / scatter.time_constant_s);
      mean *= phi;
      p = phi * phi * p + variance * (1.0 - phi * phi);
    }
    const double s = p + white;
    const Eigen::RowVectorXd found = columns.row(i) - mean;
    result.row(i) = found / std::sqrt(s);
    mean += p / s * found;
    p *= white / s;
  }
  return result;
}

Eigen::VectorXd surviving(const Eigen::VectorXd& signal, const Eigen::MatrixXd& model) {
  Eigen::MatrixXd even = model;  // columns of very different size
  even.colwise().normalize();
  return signal - even * even.colPivHouseholderQr().solve(signal);
}

}  // namespace ballbar::verdicts

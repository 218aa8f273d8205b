#include "history/fit_columns.hpp"

#include <cmath>

#include "ballbar/history/trend.hpp"
#include "ballbar/units.hpp"

namespace ballbar {

FitColumns trend_columns(std::span<const double> time_s) {
  const double middle_s = 0.5 * (time_s.front() + time_s.back());
  FitColumns columns(static_cast<Eigen::Index>(time_s.size()), 2);
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    columns(row, 0) = 1.0;
    columns(row, 1) = (time_s[i] - middle_s) / kYear_s;
  }
  return columns;
}

FitColumns season_columns(std::span<const double> time_s) {
  FitColumns columns(static_cast<Eigen::Index>(time_s.size()), 2);
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double phase_rad = 2.0 * kPi * time_s[i] / kYear_s;
    columns(static_cast<Eigen::Index>(i), 0) = std::sin(phase_rad);
    columns(static_cast<Eigen::Index>(i), 1) = std::cos(phase_rad);
  }
  return columns;
}

FitColumns step_column(std::size_t n, std::size_t k) {
  FitColumns column = FitColumns::Zero(static_cast<Eigen::Index>(n), 1);
  column.bottomRows(static_cast<Eigen::Index>(n - k)).setOnes();
  return column;
}

FitColumns joined(const FitColumns& left, const FitColumns& right) {
  FitColumns both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

}  // namespace ballbar

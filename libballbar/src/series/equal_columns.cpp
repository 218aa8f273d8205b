#include "series/equal_columns.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "series/resolution.hpp"

namespace ballbar {
namespace {

constexpr double kOfAStep = 1.0 + 1e-6;  // of two rounded columns, in steps of the coarser
constexpr double kOfTheRange = 1e-9;     // without steps
constexpr double kLeastSlope = 0.9, kMostSlope = 1.1;
constexpr double kSigmas = 4.0, kSigmaOfLag = 0.5;             // rows
constexpr Eigen::Index kFewestValues = 48, kFewestMeans = 12;  // the slope is that of 48 means
constexpr Eigen::Index kRowsOfRate = 2;                        // rows on either side, of the rate of change

Eigen::ArrayXd about_mean(const Eigen::ArrayXd& values) { return values - values.mean(); }

Eigen::ArrayXd means_of(const Eigen::ArrayXd& values, Eigen::Index rows) {
  const Eigen::Index count = values.size() / rows;
  return Eigen::ArrayXXd::Map(values.data(), rows, count).colwise().mean().transpose();
}

// The reduced major axis of means, in which the noise of the sensors is small.
double slope_of(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
  const Eigen::Index rows = x.size() / kFewestValues;
  const Eigen::ArrayXd about_x = about_mean(means_of(x, rows)), about_y = about_mean(means_of(y, rows));
  return std::copysign(std::sqrt(about_y.square().sum() / about_x.square().sum()), (about_x * about_y).sum());
}

// Whether neighbours differ as much as any two values.
bool is_white(Eigen::ArrayXd values) {
  for (; values.size() >= kFewestMeans; values = means_of(values, 2)) {
    const Eigen::Index n = values.size();
    const double ratio = (values.tail(n - 1) - values.head(n - 1)).square().sum() / about_mean(values).square().sum();
    const double count = static_cast<double>(n);
    if (!(ratio > 2.0 - kSigmas * 2.0 * std::sqrt((count - 2.0) / (count * count - 1.0)))) return false;
  }
  return true;
}

// Of the remainder r = y - x, if y lags x by L rows: r = -L dx/drow.
bool has_no_lag(const Eigen::ArrayXd& x, const Eigen::ArrayXd& rest) {
  const Eigen::Index inner = x.size() - 2 * kRowsOfRate;
  const Eigen::ArrayXd rate = about_mean((x.tail(inner) - x.head(inner)) / static_cast<double>(2 * kRowsOfRate));
  const Eigen::ArrayXd r = about_mean(rest.segment(kRowsOfRate, inner));
  const double squares = rate.square().sum(), lag = (rate * r).sum() / squares;
  const double sigma = std::sqrt((r - lag * rate).square().sum() / static_cast<double>(inner) / squares);
  return std::abs(lag) <= kSigmas * sigma + kOfTheRange && sigma < kSigmaOfLag;
}

}  // namespace

std::optional<LinearRelation> equal_columns(const std::vector<double>& column, const std::vector<double>& other,
                                            std::size_t rows) {
  std::vector<double> known_x, known_y;
  for (std::size_t i = 0; i < column.size(); i += rows) {
    if (std::isfinite(column[i]) != std::isfinite(other[i])) return std::nullopt;
    if (!std::isfinite(column[i])) continue;
    known_x.push_back(column[i]);
    known_y.push_back(other[i]);
  }
  const auto count = static_cast<Eigen::Index>(known_x.size());
  if (count < kFewestValues) return std::nullopt;
  const Eigen::ArrayXd x = Eigen::ArrayXd::Map(known_x.data(), count), y = Eigen::ArrayXd::Map(known_y.data(), count);
  const double slope = slope_of(x, y);
  if (!(slope >= kLeastSlope && slope <= kMostSlope)) return std::nullopt;
  const Eigen::ArrayXd rest = about_mean(y - slope * x);
  if (!has_no_lag(slope * x, rest)) return std::nullopt;
  if (!is_white(rest)) {
    const double step = std::max(slope * resolution_of(column), resolution_of(other));
    const double spread = std::sqrt(about_mean(y).square().mean());
    if (rest.abs().maxCoeff() > std::max(kOfAStep * step, kOfTheRange * spread)) return std::nullopt;
  }
  return LinearRelation{y.mean() - slope * x.mean(), slope};
}

}  // namespace ballbar

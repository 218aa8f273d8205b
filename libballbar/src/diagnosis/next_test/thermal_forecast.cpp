#include "diagnosis/next_test/thermal_forecast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "ballbar/series/series.hpp"
#include "effects/low_pass.hpp"

namespace ballbar {
namespace {

constexpr std::array kExponents{5.0 / 3.0, 1.0, 2.0};  // the first unless another leaves clearly less
constexpr std::array kOfSpeed_s{0.0, 300.0, 1200.0, 3600.0, 10800.0};
constexpr std::array kOfRoom_s{0.0, 1800.0, 7200.0, 21600.0};
constexpr std::array kOfCoolant_s{0.0, 600.0, 3600.0};
constexpr std::array kDecays_s{1800.0, 5400.0};
constexpr std::size_t kMostRows = 400;  // that the gains are learned from
constexpr Eigen::Index kFewestReadings = 8;
constexpr double kDamping = 1e-5;  // of a column's own square
constexpr double kClearly = 0.9;
constexpr int kMostSweeps = 2000;

// All columns but the decays, the constant first.
Eigen::MatrixXd driven(const Drives& drives, double exponent) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(drives.time_s.size()), 1);
  const auto add_low_passes = [&](const std::vector<double>& drive, std::span<const double> time_constants_s) {
    for (const double tau_s : time_constants_s) {
      if (drive.empty()) return;
      columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
      double* out = columns.col(columns.cols() - 1).data();
      for (const RowRange& run : runs_of(drives.time_s)) {
        low_pass(
            std::span(drives.time_s).subspan(run.begin, run.end - run.begin),
            [&](std::size_t i) { return drive[run.begin + i]; }, tau_s, out + run.begin);
      }
    }
  };
  std::vector<double> power;
  for (const double rpm : drives.speed) power.push_back(std::pow(std::abs(rpm) / 1000.0, exponent));
  add_low_passes(power, kOfSpeed_s);
  add_low_passes(drives.room, kOfRoom_s);
  add_low_passes(drives.coolant, kOfCoolant_s);
  return columns;
}

// The constant and the decays.
Eigen::MatrixXd at_rest(const std::vector<double>& time_s) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(time_s.size()), 1 + kDecays_s.size());
  for (const RowRange& run : runs_of(time_s)) {
    for (std::size_t row = run.begin; row < run.end; ++row) {
      for (std::size_t k = 0; k < kDecays_s.size(); ++k) {
        columns(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(k) + 1) =
            std::exp(-(time_s[row] - time_s[run.begin]) / kDecays_s[k]);
      }
    }
  }
  return columns;
}

struct SolvedGains {
  Eigen::VectorXd gains;
  double square = 0.0;  // sum of squares that is left
};

// Least squares with gains >= 0 in the columns after the first `free` ones, coordinate by coordinate. The first column
// is ones. Damped by the square of each column about its mean, but for the ones.
SolvedGains solved(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, Eigen::Index free) {
  const Eigen::Index m = x.cols() - 1;
  const Eigen::RowVectorXd mean = x.rightCols(m).colwise().mean();
  const double level = y.mean();
  Eigen::MatrixXd unit = x.rightCols(m).rowwise() - mean;
  Eigen::VectorXd scale = unit.colwise().norm();
  for (Eigen::Index k = 0; k < m; ++k) {
    if (!(scale[k] > 1e-9)) scale[k] = std::numeric_limits<double>::infinity();  // nothing to learn
    unit.col(k) /= scale[k];
  }
  Eigen::MatrixXd gram = unit.transpose() * unit;
  gram.diagonal().array() += kDamping;
  const Eigen::VectorXd along = unit.transpose() * (y.array() - level).matrix();
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(m);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double moved = 0.0;
    for (Eigen::Index k = 0; k < m; ++k) {
      double next = gains[k] + (along[k] - gram.row(k).dot(gains)) / gram(k, k);
      if (k + 1 >= free) next = std::max(0.0, next);
      moved = std::max(moved, std::abs(next - gains[k]));
      gains[k] = next;
    }
    if (moved <= 1e-6 * gains.cwiseAbs().maxCoeff()) break;
  }
  SolvedGains result;
  result.gains.resize(m + 1);
  result.gains.tail(m) = gains.cwiseQuotient(scale);
  result.gains[0] = level - mean.dot(result.gains.tail(m));
  result.square = (y - x * result.gains).squaredNorm();
  return result;
}

}  // namespace

std::vector<Forecast> forecasts_of(const Drives& drives, const std::vector<std::vector<double>>& values) {
  std::vector<Eigen::MatrixXd> bases;
  for (const double exponent : kExponents) bases.push_back(driven(drives, exponent));
  const Eigen::MatrixXd resting = at_rest(drives.time_s);
  const Eigen::Index driving = bases.front().cols() - 1;
  std::vector<Forecast> result;
  for (const std::vector<double>& column : values) {
    std::vector<Eigen::Index> rows;
    const std::size_t stride = 1 + column.size() / kMostRows;
    std::size_t known = 0;
    for (std::size_t row = 0; row < column.size(); ++row) {
      if (std::isfinite(column[row]) && known++ % stride == 0) rows.push_back(static_cast<Eigen::Index>(row));
    }
    const Eigen::VectorXd y = Eigen::VectorXd::Map(column.data(), static_cast<Eigen::Index>(column.size()))(rows);
    Forecast best;
    best.gains = Eigen::VectorXd::Zero(driving + 1);
    if (y.size() > 0) best.gains[0] = y.mean();
    if (y.size() > 0 && y.maxCoeff() - y.minCoeff() < 1e-9) {
      best.r2 = 1.0;
    } else if (y.size() >= kFewestReadings) {
      const Eigen::MatrixXd free = resting(rows, Eigen::all);
      const double alone = solved(free, y, free.cols()).square;
      for (std::size_t e = 0; e < bases.size(); ++e) {
        Eigen::MatrixXd x(y.size(), free.cols() + driving);
        x << free, bases[e].rightCols(driving)(rows, Eigen::all);
        const SolvedGains found = solved(x, y, free.cols());
        const double r2 = 1.0 - found.square / alone;
        if (!(1.0 - r2 < kClearly * (1.0 - best.r2)) || !found.gains.allFinite()) continue;
        best.exponent = kExponents[e];
        best.r2 = r2;
        best.gains << found.gains[0], found.gains.tail(driving);
      }
    }
    result.push_back(std::move(best));
  }
  return result;
}

std::vector<double> predicted(const Forecast& forecast, const Drives& drives) {
  const Eigen::MatrixXd columns = driven(drives, forecast.exponent);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(columns.rows());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) sum += forecast.gains[k] * columns.col(k);
  return {sum.begin(), sum.end()};
}

}  // namespace ballbar

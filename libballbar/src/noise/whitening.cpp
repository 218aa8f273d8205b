#include "noise/whitening.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/units.hpp"

namespace ballbar {

namespace {

// A row, of one column or several, becomes its innovations times `scale`; s: before this row, the last one's decay not
// yet in it, one a column.
template <class Row, class State>
void filter_row(const FilterGain& of, double scale, Row&& row, State&& s) {
  s *= of.decay;
  row -= s;
  s += of.gain * row;
  row *= scale;
}

// One reading, with a discrepancy.
void filter_reading(const FilterGain& of, double scale, double& reading, double& s, double& m, double& slope) {
  const double s0 = of.decay * s;
  const double m0 = of.f00 * m + of.f01 * slope;
  const double m1 = of.f10 * m + of.f11 * slope;
  const double innovation = reading - s0 - m0;
  s = s0 + of.gain * innovation;
  m = m0 + of.gain_slow * innovation;
  slope = m1 + of.gain_slope * innovation;
  reading = innovation * scale;
}

}  // namespace

Whitening::Whitening(const Covariance& covariance, std::span<const double> time_s, const RowScatter& rows)
    : has_slow_(covariance.slow > 0.0), has_memory_(covariance.correlated > 0.0) {
  gain_of_row_.reserve(time_s.size());
  log_determinant_ =
      LinearFilter(time_s, rows).for_each_gain(covariance, [&](const FilterGain& of, Eigen::Index count) {
        gain_of_row_.insert(gain_of_row_.end(), static_cast<std::size_t>(count),
                            static_cast<std::uint32_t>(gains_.size()));
        gains_.push_back({of, std::sqrt(of.weight)});
      });
  for (std::size_t i = 0; i < rows.variance.size(); ++i) {
    if (rows.variance[i] < kUnknownVariance) continue;
    ++unknown_;
    log_determinant_ += 2.0 * std::log(of_row(i).scale);
  }
}

Whitening::Whitening(const Noise& noise, std::span<const double> time_s, std::span<const double> sigma_um,
                     std::span<const std::size_t> left_out)
    : Whitening(variances_of(noise), time_s, {.variance = squares_of(sigma_um), .left_out = left_out}) {}

void Whitening::apply(const double* column, std::size_t stride, double* out, std::size_t out_stride) const {
  double s = 0.0, m = 0.0, slope = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const auto& [of, scale] = of_row(i);
    double value = column[i * stride];
    if (has_slow_) {
      filter_reading(of, scale, value, s, m, slope);
    } else {
      filter_row(of, scale, value, s);
    }
    out[i * out_stride] = value;
  }
}

void Whitening::apply(std::size_t first, RowMajorBlock block, RowMajorMatrix& state) const {
  if (block.cols() == 0) return;
  for (Eigen::Index i = 0; i < block.rows(); ++i) {
    const auto& [of, scale] = of_row(first + static_cast<std::size_t>(i));
    auto values = block.row(i).array();
    auto s = state.row(0).array();
    if (has_slow_) {
      auto m = state.row(1).array();
      auto slope = state.row(2).array();
      const Eigen::Index columns = block.cols();
      double* v = &block(i, 0);
      for (Eigen::Index k = 0; k < columns; ++k) filter_reading(of, scale, v[k], s(k), m(k), slope(k));
    } else if (has_memory_) {
      filter_row(of, scale, values, s);
    } else {
      values *= scale;
    }
  }
}

// The filter is e = y - H F x, x' = F x + K e, w = e scale; this is its adjoint, backwards.
RowMajorMatrix Whitening::transposed(RowMajorMatrix white) const {
  const Eigen::Index columns = white.cols();
  Eigen::ArrayXXd adjoint = Eigen::ArrayXXd::Zero(3, columns);
  for (Eigen::Index i = white.rows() - 1; i >= 0; --i) {
    const auto& [of, scale] = of_row(static_cast<std::size_t>(i));
    for (Eigen::Index k = 0; k < columns; ++k) {
      double& s = adjoint(0, k);
      double& m = adjoint(1, k);
      double& slope = adjoint(2, k);
      const double e = white(i, k) * scale + of.gain * s + of.gain_slow * m + of.gain_slope * slope;
      const double level = m - e;
      s = of.decay * (s - e);
      m = of.f00 * level + of.f10 * slope;
      slope = of.f01 * level + of.f11 * slope;
      white(i, k) = e;
    }
  }
  return white;
}

// Of z = (state, 1) before a row the squares from there on are z' M z, M by a recursion backwards; a column that begins
// there has no state.
Eigen::VectorXd Whitening::squares_of_steps() const {
  using Matrix = Eigen::Matrix4d;
  Eigen::VectorXd squares(static_cast<Eigen::Index>(size()));
  Matrix m = Matrix::Zero();
  for (Eigen::Index i = squares.size() - 1; i >= 0; --i) {
    const auto& [of, scale] = of_row(static_cast<std::size_t>(i));
    const Eigen::RowVector4d innovation(-of.decay, -of.f00, -of.f01, 1.0);
    Matrix next = Matrix::Zero();
    next(0, 0) = of.decay;
    next(1, 1) = of.f00;
    next(1, 2) = of.f01;
    next(2, 1) = of.f10;
    next(2, 2) = of.f11;
    next(3, 3) = 1.0;
    next += Eigen::Vector4d(of.gain, of.gain_slow, of.gain_slope, 0.0) * innovation;
    m = scale * scale * innovation.transpose() * innovation + next.transpose() * m * next;
    squares[i] = m(3, 3);
  }
  return squares;
}

RowMajorMatrix whitened_rows(const Whitening& whitening, RowMajorMatrix columns) {
  RowMajorMatrix state = RowMajorMatrix::Zero(3, columns.cols());
  whitening.apply(0, columns, state);
  return columns;
}

Eigen::MatrixXd whitened(const Whitening& whitening, const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  // The filter goes from row to row; columns beside one another fill the time that each step has to wait.
  constexpr Eigen::Index kTogether = 8, kRows = 256;
  const Eigen::Index n = columns.rows();
  Eigen::MatrixXd out(n, columns.cols());
  RowMajorMatrix block(std::min(kRows, n), kTogether);
  Eigen::Index k = 0;
  for (; k + kTogether <= columns.cols(); k += kTogether) {
    RowMajorMatrix state = RowMajorMatrix::Zero(3, kTogether);
    for (Eigen::Index first = 0; first < n; first += kRows) {
      auto part = block.topRows(std::min(kRows, n - first));
      part = columns.block(first, k, part.rows(), kTogether);
      whitening.apply(static_cast<std::size_t>(first), part, state);
      out.block(first, k, part.rows(), kTogether) = part;
    }
  }
  for (; k < columns.cols(); ++k) whitening.apply(columns.col(k).data(), 1, out.col(k).data(), 1);
  return out;
}

bool has_heavy_tails(const Eigen::VectorXd& white) {
  constexpr double kDegrees = 4.0;
  constexpr int kRounds = 20;
  if (white.size() < 2) return false;
  const auto n = static_cast<double>(white.size());
  const Eigen::ArrayXd square = (white.array() - white.mean()).square();
  const double variance = square.mean();
  if (!(variance > 0.0)) return false;
  double scale2 = 0.5 * variance;
  for (int round = 0; round < kRounds; ++round) {
    scale2 = ((kDegrees + 1.0) * square / (kDegrees + square / scale2)).mean();
    if (!(scale2 > 0.0)) return true;  // most of them the same
  }
  const double normal = -0.5 * n * (std::log(2.0 * kPi * variance) + 1.0);
  const double width =
      std::lgamma(0.5 * (kDegrees + 1.0)) - std::lgamma(0.5 * kDegrees) - 0.5 * std::log(kDegrees * kPi * scale2);
  const double student = n * width - 0.5 * (kDegrees + 1.0) * (1.0 + square / (kDegrees * scale2)).log().sum();
  return student > normal;
}

}  // namespace ballbar

// |L' x|^2 for a lower triangular L: the variance of x'w where L L' is the covariance of w.
//
//   |L' x|^2 = sum_j (sum_{i >= j} L_ij x_i)^2
//
// n^2 / 2 products for each x, half of the cost of a prediction. Both sums run upwards, product by product, so that one
// x, several at once, and any processor give identical results.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace ballbar {

class LowerFactor {
 public:
  static constexpr std::size_t kAtOnce = 8;
  using Eight = std::array<double, kAtOnce>;

  // n by n; the part above the diagonal is ignored.
  explicit LowerFactor(const Eigen::MatrixXd& lower);

  // |L' x|^2 of one x of n finite numbers. `room`: workspace of n numbers. Allocates no memory.
  double squared_norm(const double* x, double* room) const;

  // The same for eight vectors at once: x[i] holds the i-th number of each.
  Eight squared_norms(const Eight* x) const;

 private:
  // 64 bytes, a line of the cache.
  struct alignas(64) Line {
    Eight values;
  };

  const double* numbers() const { return reinterpret_cast<const double*>(rows_.data()); }

  std::size_t n_ = 0, stride_ = 0;
  std::vector<Line> rows_;  // row by row; 0 above the diagonal and in the padding
};

}  // namespace ballbar

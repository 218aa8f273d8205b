#include "ballbar/numerics/lower_factor.hpp"

// Compiled for both, and chosen as the program starts. AVX2 alone has no additions fused with multiplications, which
// round otherwise.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__)
#define BALLBAR_WITH_AVX2 [[gnu::target_clones("avx2", "default")]]
#else
#define BALLBAR_WITH_AVX2
#endif

namespace ballbar {
namespace {

constexpr std::size_t kTogether = 4;  // columns of L for eight x; rows for one x

std::size_t filled_up(std::size_t n, std::size_t to) { return (n + to - 1) / to * to; }

BALLBAR_WITH_AVX2
void squared_norms_of(const double* lower, std::size_t stride, std::size_t n, const LowerFactor::Eight* x,
                      LowerFactor::Eight& total) {
  constexpr std::size_t kAtOnce = LowerFactor::kAtOnce;
  for (std::size_t first = 0; first < n; first += kTogether) {
    double sum[kTogether][kAtOnce] = {};
    for (std::size_t i = first; i < n; ++i) {
      const double* const row = lower + i * stride + first;
      for (std::size_t j = 0; j < kTogether; ++j) {
        for (std::size_t k = 0; k < kAtOnce; ++k) sum[j][k] += row[j] * x[i][k];
      }
    }
    for (std::size_t j = 0; j < kTogether; ++j) {
      for (std::size_t k = 0; k < kAtOnce; ++k) total[k] += sum[j][k] * sum[j][k];
    }
  }
}

// sum_j = sum_{i >= j} L_ij x_i
BALLBAR_WITH_AVX2
void sums_of(const double* lower, std::size_t stride, std::size_t n, const double* x, double* __restrict sum) {
  for (std::size_t j = 0; j < n; ++j) sum[j] = 0.0;
  std::size_t i = 0;
  for (; i + kTogether <= n; i += kTogether) {
    const double *const a = lower + i * stride, *const b = a + stride, *const c = b + stride, *const d = c + stride;
    const double xa = x[i], xb = x[i + 1], xc = x[i + 2], xd = x[i + 3];
    for (std::size_t j = 0; j < i + kTogether; ++j) {
      sum[j] = (((sum[j] + a[j] * xa) + b[j] * xb) + c[j] * xc) + d[j] * xd;
    }
  }
  for (; i < n; ++i) {
    const double* const row = lower + i * stride;
    for (std::size_t j = 0; j <= i; ++j) sum[j] += row[j] * x[i];
  }
}

}  // namespace

LowerFactor::LowerFactor(const Eigen::MatrixXd& lower) : n_(static_cast<std::size_t>(lower.rows())) {
  // An odd number of lines: of an even one, the lines of a column lie in the same few places of a cache.
  const std::size_t lines = filled_up(n_, kAtOnce) / kAtOnce | 1;
  stride_ = lines * kAtOnce;
  rows_.resize(n_ * lines, Line{});
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      rows_[i * lines + j / kAtOnce].values[j % kAtOnce] =
          lower(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
}

double LowerFactor::squared_norm(const double* x, double* room) const {
  sums_of(numbers(), stride_, n_, x, room);
  double total = 0.0;
  for (std::size_t j = 0; j < n_; ++j) total += room[j] * room[j];
  return total;
}

LowerFactor::Eight LowerFactor::squared_norms(const Eight* x) const {
  Eight total{};
  squared_norms_of(numbers(), stride_, n_, x, total);
  return total;
}

}  // namespace ballbar

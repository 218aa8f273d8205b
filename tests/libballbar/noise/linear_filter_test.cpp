// The filter against the covariance matrix written out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "diagnosis/evidence/dense.hpp"
#include "noise/discrepancy_grid.hpp"
#include "noise/restricted_likelihood.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

struct Rows {
  std::vector<double> time_s, relative_variance;
};

Rows even(std::size_t n, double step_s = 15.0) {
  Rows rows;
  for (std::size_t i = 0; i < n; ++i) rows.time_s.push_back(step_s * static_cast<double>(i));
  return rows;
}

// Steps of 0.3 to 900 s, some alike.
Rows uneven(std::size_t n) {
  Rows rows;
  double now = 5.0;
  const double steps_s[] = {15.0, 15.0, 0.3, 61.0, 15.0, 900.0, 7.5, 7.5, 7.5};
  for (std::size_t i = 0; i < n; ++i) rows.time_s.push_back(now += steps_s[i % 9]);
  return rows;
}

// Three runs, each from its own beginning; the second begins at a time of the first.
Rows runs() {
  Rows rows = even(20);
  for (std::size_t i = 0; i < 20; ++i) rows.time_s.push_back(60.0 + 20.0 * static_cast<double>(i));
  for (std::size_t i = 0; i < 20; ++i) rows.time_s.push_back(15.0 * static_cast<double>(i));
  return rows;
}

Rows weighted(Rows rows) {
  const double variances[] = {1.0, 1.0, 0.2, 1e6, 1.0, 3.0, 1.0};
  for (std::size_t i = 0; i < rows.time_s.size(); ++i) rows.relative_variance.push_back(variances[i % 7]);
  return rows;
}

Eigen::MatrixXd normal_columns(Eigen::Index n, Eigen::Index columns) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(n, columns, [&] { return normal(random); });
}

// Innovations are columns of a triangular W with W' W = C^-1: their products are those of C^-1, whatever is chosen.
void expect_dense(const Covariance& covariance, const Rows& rows, const std::string& what) {
  const Whitening filter(covariance, rows.time_s, {.relative_variance = rows.relative_variance});
  const auto n = static_cast<Eigen::Index>(rows.time_s.size());
  const Eigen::MatrixXd c = dense::matrix_of(covariance, rows.time_s, rows.relative_variance);
  const Eigen::MatrixXd columns = normal_columns(n, 3);
  RowMajorMatrix white = columns, state = RowMajorMatrix::Zero(3, 3);
  filter.apply(0, white, state);
  const Eigen::MatrixXd expected = columns.transpose() * c.llt().solve(columns);
  const Eigen::MatrixXd found = white.transpose() * white;
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff()) << what;
  EXPECT_NEAR(filter.log_determinant(), dense::log_determinant(c), 1e-9 * static_cast<double>(n)) << what;
}

Covariance white() { return {}; }
Covariance memory() { return {0.2, 0.8, 200.0, 0.0, 0.0, 0.0}; }
Covariance slow_alone() { return {1.0, 0.0, 0.0, 6.25, 400.0, 0.0}; }
Covariance all() { return {0.3, 0.7, 90.0, 2.0, 1500.0, 0.0}; }

TEST(Covariance, filter_is_the_dense_matrix) {
  const std::pair<const char*, Covariance> kinds[] = {
      {"white", white()}, {"memory", memory()}, {"slow", slow_alone()}, {"all", all()}};
  for (const auto& [name, covariance] : kinds) {
    const std::string kind = name;
    expect_dense(covariance, even(60), kind + ", even");
    expect_dense(covariance, uneven(60), kind + ", uneven");
    expect_dense(covariance, runs(), kind + ", time goes back");
    expect_dense(covariance, weighted(even(60)), kind + ", weighted");
    expect_dense(covariance, weighted(uneven(60)), kind + ", weighted and uneven");
    expect_dense(covariance, weighted(runs()), kind + ", weighted, time goes back");
  }
}

// Where steps repeat the gains settle and are no longer computed; then a gap, a bad reading, another step.
TEST(Covariance, a_settled_filter_goes_on_rightly) {
  for (const Covariance& covariance : {memory(), slow_alone(), all()}) {
    Rows rows = even(250);
    rows.relative_variance.assign(250, 1.0);
    rows.relative_variance[150] = 1e6;
    for (std::size_t i = 200; i < 250; ++i) rows.time_s[i] += 5000.0;
    for (std::size_t i = 225; i < 250; ++i) rows.time_s[i] += 7.0 * static_cast<double>(i - 225);
    expect_dense(covariance, rows, "settled");
  }
}

// Columns in blocks of rows are columns in one.
TEST(Covariance, blocks_are_the_whole) {
  const Rows rows = uneven(60);
  const Whitening filter(all(), rows.time_s);
  const Eigen::MatrixXd columns = normal_columns(60, 2);
  RowMajorMatrix whole = columns, state = RowMajorMatrix::Zero(3, 2);
  filter.apply(0, whole, state);
  state.setZero();
  for (const auto& [first, rows_of] : {std::pair{0, 1}, {1, 31}, {32, 28}}) {
    RowMajorMatrix block = columns.middleRows(first, rows_of);
    filter.apply(static_cast<std::size_t>(first), block, state);
    EXPECT_LT((block - whole.middleRows(first, rows_of)).cwiseAbs().maxCoeff(), 1e-12);
  }
}

// A memory that is long beside the steps is nearly a constant that is not known: -1/2 ln |C| of two rows by hand.
// C = (1, r; r, 1), r = 0.8 exp(-1/4): |C| = 1 - r^2.
TEST(Covariance, two_rows_by_hand) {
  const std::vector<double> time_s{0.0, 50.0};
  const Whitening filter(memory(), time_s);
  const double r = 0.8 * std::exp(-0.25);
  EXPECT_NEAR(filter.log_determinant(), std::log(1.0 - r * r), 1e-12);
  RowMajorMatrix column(2, 1), state = RowMajorMatrix::Zero(3, 1);
  column << 3.0, 5.0;
  filter.apply(0, column, state);
  EXPECT_NEAR(column(0, 0), 3.0, 1e-12);
  EXPECT_NEAR(column(1, 0), (5.0 - 3.0 * r) / std::sqrt(1.0 - r * r), 1e-12);
}

// W' by hand: (W x)' w = x' (W' w) for all x and w.
TEST(Covariance, transposed_is_the_adjoint) {
  for (const Covariance& covariance : {white(), memory(), slow_alone(), all()}) {
    for (const Rows& rows : {uneven(60), weighted(even(60)), runs()}) {
      const Whitening filter(covariance, rows.time_s, {.relative_variance = rows.relative_variance});
      const Eigen::MatrixXd x = normal_columns(60, 3), w = normal_columns(60, 2);
      RowMajorMatrix white_x = x, state = RowMajorMatrix::Zero(3, 3);
      filter.apply(0, white_x, state);
      const RowMajorMatrix adjoint = filter.transposed(w);
      EXPECT_LT((white_x.transpose() * w - x.transpose() * adjoint).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
}

// Each step written out and filtered.
TEST(Covariance, squares_of_steps) {
  for (const Covariance& covariance : {white(), memory(), slow_alone(), all()}) {
    for (const Rows& rows : {uneven(40), weighted(even(40))}) {
      const Whitening filter(covariance, rows.time_s, {.relative_variance = rows.relative_variance});
      const Eigen::VectorXd squares = filter.squares_of_steps();
      for (Eigen::Index k = 0; k < 40; ++k) {
        RowMajorMatrix step = RowMajorMatrix::Zero(40, 1), state = RowMajorMatrix::Zero(3, 1);
        step.bottomRows(40 - k).setOnes();
        filter.apply(0, step, state);
        EXPECT_NEAR(squares[k], step.squaredNorm(), 1e-9 * step.squaredNorm()) << k;
      }
    }
  }
}

// Rows that are means share less, or more, of the memory (h), and have a variance of their own, which may be below 0; a
// start remembers nothing, though time goes on: C(i, j) = h_i h_j q^2 exp(-|dt| / theta) within a part, written out.
// Many readings of a standstill, 200 memories long, are one row: of it and its neighbours, single readings that each
// forget it, every innovation has the variance of its row.
TEST(Covariance, a_row_of_a_long_standstill_has_its_variance) {
  const double share = std::sinh(100.0) / (400.0 * std::sinh(0.25)), variance = 0.01;
  const std::vector<double> time_s{0.0, 20.0, 1040.0, 2060.0, 2080.0}, shares{1.0, 1.0, share, 1.0, 1.0};
  const std::vector<double> variances{1.0, 1.0, variance, 1.0, 1.0};
  const LinearFilter filter(time_s, {.memory_share = shares, .memory_variance = variances});
  std::vector<double> found;
  const double log_variances = filter.for_each_gain({0.1, 1.0, 1.0}, [&](const FilterGain& of, Eigen::Index rows) {
    found.insert(found.end(), static_cast<std::size_t>(rows), 1.0 / of.weight);
  });
  ASSERT_EQ(found.size(), 5u);
  double logarithms = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(found[i], 0.1 + variances[i], 1e-9) << i;
    logarithms += std::log(0.1 + variances[i]);
  }
  EXPECT_NEAR(log_variances, logarithms, 1e-9);
}

TEST(Covariance, rows_that_are_means_and_starts) {
  const Covariance covariance{0.5, 1.0, 40.0};
  const std::vector<double> time_s{0.0, 10.0, 20.0, 30.0, 42.0, 50.0}, share{1.0, 1.02, 1.02, 1.1, 1.0, 0.9};
  const std::vector<double> own{0.0, -0.03, -0.03, -0.1, 0.0, 0.2}, relative{1.0, 0.5, 0.5, 0.2, 1.0, 1.0};
  std::vector<double> variance;
  for (std::size_t i = 0; i < 6; ++i) variance.push_back(share[i] * share[i] + own[i]);
  const std::vector<std::size_t> starts{0, 4};
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(6, 6);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      if ((i < 4) != (j < 4)) continue;
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      c(row, column) = share[i] * share[j] * std::exp(-std::abs(time_s[i] - time_s[j]) / 40.0);
      if (i == j) c(row, column) += 0.5 * relative[i] + own[i];
    }
  }
  const Whitening filter(
      covariance, time_s,
      {.relative_variance = relative, .memory_share = share, .memory_variance = variance, .starts = starts});
  const Eigen::MatrixXd columns = normal_columns(6, 2);
  const RowMajorMatrix white = whitened_rows(filter, columns);
  EXPECT_LT((white.transpose() * white - columns.transpose() * c.llt().solve(columns)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(filter.log_determinant(), dense::log_determinant(c), 1e-9);
}

// Columns that are 0 from one start to the next are left out there, and the sums are the same.
TEST(Covariance, columns_that_some_rows_lack) {
  const Covariance covariance = memory();
  const std::vector<double> time_s = even(300).time_s;
  const std::vector<std::size_t> starts{0, 140};
  const LinearFilter filter(time_s, {.starts = starts});
  Eigen::MatrixXd columns = normal_columns(300, 8);
  columns.block(140, 0, 160, 3).setZero();
  columns.block(0, 3, 140, 2).setZero();
  const RowMajorMatrix basis = columns;
  const Eigen::VectorXd residual = normal_columns(300, 9).col(8);
  const std::span<const double> values{residual.data(), 300};
  const LinearFilter::Sums all = RestrictedLikelihood(values, basis).sums(filter, covariance);
  const LinearFilter::Sums own = RestrictedLikelihood(values, basis, starts).sums(filter, covariance);
  EXPECT_NEAR(own.squares, all.squares, 1e-9 * all.squares);
  EXPECT_NEAR(own.log_variances, all.log_variances, 1e-9);
  // Against the covariance written out.
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(300, 300);
  for (Eigen::Index i = 0; i < 300; ++i) {
    for (Eigen::Index j = 0; j < 300; ++j) {
      if ((i < 140) != (j < 140)) continue;
      const double apart_s = std::abs(time_s[static_cast<std::size_t>(i)] - time_s[static_cast<std::size_t>(j)]);
      c(i, j) = covariance.correlated * std::exp(-apart_s / covariance.time_s) + (i == j ? covariance.white : 0.0);
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> root(c);
  const Eigen::MatrixXd g = basis.transpose() * root.solve(Eigen::MatrixXd(basis));
  const Eigen::VectorXd right = basis.transpose() * root.solve(residual);
  EXPECT_NEAR(own.squares, residual.dot(root.solve(residual)) - right.dot(g.llt().solve(right)), 1e-8 * all.squares);
  EXPECT_NEAR(own.log_variances, dense::log_determinant(c) + dense::log_determinant(g), 1e-8);
}

// What is left out tells the rows behind it nothing, with a discrepancy as without.
TEST(Covariance, rows_that_are_left_out) {
  for (const Covariance& covariance : {memory(), all()}) {
    const std::vector<double> time_s = uneven(9).time_s;
    const std::vector<std::size_t> left_out{3, 7};
    const std::vector<Eigen::Index> kept{0, 1, 2, 4, 5, 6, 8};
    std::vector<double> kept_s;
    for (const Eigen::Index row : kept) kept_s.push_back(time_s[static_cast<std::size_t>(row)]);
    const Eigen::MatrixXd columns = normal_columns(9, 2);
    const Eigen::MatrixXd white = whitened(Whitening(covariance, time_s, {.left_out = left_out}), columns);
    const Eigen::MatrixXd expected = whitened(Whitening(covariance, kept_s), columns(kept, Eigen::all));
    EXPECT_LT((white(kept, Eigen::all) - expected).cwiseAbs().maxCoeff(), 1e-9);
  }
}

double sum_of_priors(const std::vector<Covariance>& grid) {
  double sum = 0.0;
  for (const Covariance& one : grid) sum += std::exp(one.log_prior);
  return sum;
}

TEST(DiscrepancyGrid, is_a_prior) {
  for (const Rows& rows : {even(400), uneven(400), runs()}) {
    for (const Covariance& one : {white(), memory()}) {
      EXPECT_NEAR(sum_of_priors(with_discrepancy(one, rows.time_s)), std::exp(one.log_prior), 1e-12);
      for (const Covariance& slow : with_discrepancy(one, rows.time_s)) {
        EXPECT_GT(slow.slow, 0.0);
        EXPECT_GT(slow.slow_time_s, 0.0);
      }
    }
  }
  EXPECT_TRUE(with_discrepancy(white(), even(29).time_s).empty());
}

}  // namespace
}  // namespace ballbar

// How likely readings are under a line, against the whole covariance matrix.
#include "diagnosis/evidence/linear_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "diagnosis/evidence/dense.hpp"

namespace ballbar {
namespace {

constexpr Eigen::Index kN = 60;

// A constant and two gains of a model, two known columns.
struct Made {
  std::vector<double> time_s;
  Eigen::VectorXd y;
  Eigen::MatrixXd flat, known;  // n by 3, 2
};

Made made() {
  Made result;
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  result.y.resize(kN);
  result.flat.resize(kN, 3);
  result.known.resize(kN, 2);
  double memory = 0.0;
  for (Eigen::Index i = 0; i < kN; ++i) {
    const double t = 15.0 * static_cast<double>(i);
    memory = 0.8 * memory + 0.6 * normal(random);
    result.time_s.push_back(t);
    result.flat.row(i) << 1.0, std::sin(t / 90.0), t / 450.0;
    result.known.row(i) << 0.4 * std::cos(t / 70.0), 0.8 * std::sin(t / 200.0);
    result.y[i] = 3.0 + 2.0 * result.flat(i, 1) - 0.6 * result.known(i, 1) + 0.5 * memory + 0.1 * normal(random);
  }
  return result;
}

Covariance memory() { return {0.3, 0.7, 60.0, 0.0, 0.0, 0.0}; }
Covariance with_slow() { return {0.5, 0.5, 40.0, 3.0, 500.0, 0.0}; }

struct Weighing {
  Gram gram;
  LinearSolution solution;
  double log_p() const { return solution.log_evidence; }
};

// pool: y, the flat columns, the known ones.
Weighing weighing(const Made& made, const Covariance& covariance, bool with_known, const KnownScatter& known = {}) {
  RowMajorMatrix pool(kN, 1 + made.flat.cols() + (with_known ? made.known.cols() : 0));
  pool.col(0) = made.y;
  pool.middleCols(1, made.flat.cols()) = made.flat;
  if (with_known) pool.rightCols(made.known.cols()) = made.known;
  std::vector<char> is_flat;
  for (Eigen::Index k = 1; k < pool.cols(); ++k) is_flat.push_back(k <= made.flat.cols() ? 1 : 0);
  const Whitening filter(covariance, made.time_s);
  Gram gram = gram_of(filter, pool);
  LinearSolution solution = linear_solution(gram, is_flat, known);
  return {std::move(gram), std::move(solution)};
}

// Known columns of prior N(0, 1) um with the scatter s taken as `known_variance`: terms of one covariance matrix, s
// integrated over ds / s.
double by_matrix(const Made& made, const Covariance& covariance, double known_variance) {
  Eigen::MatrixXd c = dense::matrix_of(covariance, made.time_s);
  if (known_variance > 0.0) c += made.known * made.known.transpose() / known_variance;
  const dense::Flat one = dense::flat(made.y, made.flat, c);
  return dense::log_over_scale(one.square, static_cast<double>(kN - made.flat.cols())) - one.half_log;
}

// The constant that is left out is that of nu alone: covariances can be compared.
TEST(Evidence, of_covariances_is_the_marginal_likelihood) {
  const Made rows = made();
  const double white = weighing(rows, {}, false).log_p(), white_by_matrix = by_matrix(rows, {}, 0.0);
  for (const Covariance& covariance : {memory(), with_slow()}) {
    EXPECT_NEAR(weighing(rows, covariance, false).log_p() - white, by_matrix(rows, covariance, 0.0) - white_by_matrix,
                1e-6);
  }
}

// Known columns: their prior is in um, so that the scatter has to be known for it; it is taken where the model has it.
// The same variance in the matrix: 0.1 for what the last of its rounds is short of.
TEST(Evidence, of_known_columns_is_the_marginal_likelihood_at_their_scatter) {
  const Made rows = made();
  for (const Covariance& covariance : {Covariance{}, memory(), with_slow()}) {
    const Weighing found = weighing(rows, covariance, true);
    EXPECT_NEAR(found.log_p() - weighing(rows, covariance, false).log_p(),
                by_matrix(rows, covariance, found.solution.variance) - by_matrix(rows, covariance, 0.0), 0.1);
  }
}

// s known beforehand as if by so many readings: s^-(readings + 1) exp(-readings v / 2 s^2), which adds readings to nu
// and readings times v to S.
TEST(Evidence, of_a_known_scatter) {
  const Made rows = made();
  const KnownScatter known{25.0, 0.09};
  const double nu = static_cast<double>(kN - rows.flat.cols());
  const auto by_hand = [&](const Covariance& covariance) {
    const dense::Flat one = dense::flat(rows.y, rows.flat, dense::matrix_of(covariance, rows.time_s));
    return dense::log_over_scale(one.square + 25.0 * 0.09, nu + 25.0) - one.half_log;
  };
  const Weighing found = weighing(rows, memory(), false, known);
  EXPECT_NEAR(found.log_p() - weighing(rows, {}, false, known).log_p(), by_hand(memory()) - by_hand({}), 1e-6);
  const double square = dense::flat(rows.y, rows.flat, dense::matrix_of(memory(), rows.time_s)).square;
  EXPECT_NEAR(found.solution.variance, (square + 2.25) / (nu + 25.0), 1e-9);
}

// Three readings 0, 0, 3 about a constant, white: the constant is 1, S = 6, nu = 2.
TEST(Evidence, three_readings_by_hand) {
  RowMajorMatrix pool(3, 2);
  pool << 0, 1, 0, 1, 3, 1;
  const Whitening filter(Covariance{}, std::vector<double>{0.0, 1.0, 2.0});
  const LinearSolution found = linear_solution(gram_of(filter, pool), {1}, {});
  EXPECT_NEAR(found.square, 6.0, 1e-8);
  EXPECT_NEAR(found.degrees, 2.0, 0.0);
  EXPECT_NEAR(found.variance, 3.0, 1e-8);
  EXPECT_NEAR(found.coefficients[0], 1.0, 1e-9);
}

// All readings in nm: known columns too, their prior is of what a model makes. What is compared stays.
TEST(Evidence, differences_go_with_the_unit_of_the_readings_nowhere) {
  Made rows = made();
  const double um = weighing(rows, with_slow(), true).log_p() - weighing(rows, memory(), true).log_p();
  rows.y *= 1000.0;
  rows.known *= 1000.0;
  EXPECT_NEAR(weighing(rows, with_slow(), true).log_p() - weighing(rows, memory(), true).log_p(), um, 1e-6);
}

TEST(Gram, is_the_products_over_the_dense_matrix) {
  const Made rows = made();
  const Weighing found = weighing(rows, with_slow(), false);
  const Eigen::LLT<Eigen::MatrixXd> c(dense::matrix_of(with_slow(), rows.time_s));
  Eigen::MatrixXd pool(kN, 4);
  pool << rows.y, rows.flat;
  const Eigen::MatrixXd among = pool.transpose() * c.solve(pool);
  EXPECT_EQ(found.gram.rows, kN);
  EXPECT_LT((found.gram.products - among).cwiseAbs().maxCoeff(), 1e-9 * among.cwiseAbs().maxCoeff());
}

TEST(LogSum, of_large_and_of_no_numbers) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(log_sum(std::vector<double>{1000.0, 1000.0}), 1000.0 + std::log(2.0), 1e-12);
  EXPECT_NEAR(log_sum(std::vector<double>{-inf, -3.0}), -3.0, 1e-12);
  EXPECT_EQ(log_sum(std::vector<double>{}), -inf);
  EXPECT_EQ(log_sum(std::vector<double>{-inf, -inf}), -inf);
}

// A column that the others make: no more is known of them than without it.
TEST(Evidence, columns_that_are_the_same_have_an_evidence) {
  Made rows = made();
  Eigen::MatrixXd more(kN, 4);
  more << rows.flat, rows.flat.col(1) - 2.0 * rows.flat.col(0);
  const double square = weighing(rows, memory(), false).solution.square;
  rows.flat = more;
  const Weighing found = weighing(rows, memory(), false);
  EXPECT_TRUE(std::isfinite(found.log_p()));
  EXPECT_NEAR(found.solution.square, square, 1e-6 * square);
}

}  // namespace
}  // namespace ballbar

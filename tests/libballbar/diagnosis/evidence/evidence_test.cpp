// How likely readings are under a set of effects, against the whole covariance matrix.
#include "diagnosis/evidence/evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ballbar/diagnosis/thresholds.hpp"
#include "diagnosis/evidence/dense.hpp"

namespace ballbar {
namespace {

constexpr Eigen::Index kN = 60;

// A constant, two gains of a model, three columns of which one or more may be missing; the first one is.
struct Made {
  std::vector<double> time_s;
  Eigen::VectorXd y;
  Eigen::MatrixXd flat, known, signatures;  // n by 3, 2, 3
};

Made made() {
  Made result;
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  result.y.resize(kN);
  result.flat.resize(kN, 3);
  result.known.resize(kN, 2);
  result.signatures.resize(kN, 3);
  double memory = 0.0;
  for (Eigen::Index i = 0; i < kN; ++i) {
    const double t = 15.0 * static_cast<double>(i);
    memory = 0.8 * memory + 0.6 * normal(random);
    result.time_s.push_back(t);
    result.flat.row(i) << 1.0, std::sin(t / 90.0), t / 450.0;
    result.known.row(i) << 0.4 * std::cos(t / 70.0), 0.8 * std::sin(t / 200.0);
    result.signatures.row(i) << std::sin(t / 40.0), std::cos(t / 130.0) + 0.3 * std::sin(t / 40.0), i > 25 ? 1.0 : -0.5;
    result.y[i] = 3.0 + 2.0 * result.flat(i, 1) + 1.1 * result.signatures(i, 0) - 0.6 * result.known(i, 1) +
                  0.5 * memory + 0.1 * normal(random);
  }
  return result;
}

Covariance memory() { return {0.3, 0.7, 60.0, 0.0, 0.0, 0.0}; }
Covariance with_slow() { return {0.5, 0.5, 40.0, 3.0, 500.0, 0.0}; }

struct Weighing {
  Gram gram;
  Solved solution;
  RowMajorMatrix signatures;
  CovarianceFilter filter;

  double of(const std::vector<Eigen::Index>& chosen) const {
    if (chosen.empty()) return log_evidence(solution);
    Eigen::MatrixXd left = products_of(filter, signatures, chosen);
    const Eigen::MatrixXd cross = solution.cross(Eigen::all, chosen);
    left -= cross.transpose() * cross;
    return log_evidence(solution, left, solution.along(chosen));
  }
};

// pool: y, the flat columns, the known ones.
Weighing weighing(const Made& made, const Covariance& covariance, bool with_known, const KnownScatter& known = {}) {
  RowMajorMatrix pool(kN, 1 + made.flat.cols() + (with_known ? made.known.cols() : 0));
  pool.col(0) = made.y;
  pool.middleCols(1, made.flat.cols()) = made.flat;
  if (with_known) pool.rightCols(made.known.cols()) = made.known;
  Line line;
  for (Eigen::Index k = 1; k < pool.cols(); ++k) {
    line.columns.push_back(k);
    line.is_free.push_back(k <= made.flat.cols() ? 1 : 0);
  }
  CovarianceFilter filter(covariance, made.time_s, {});
  const RowMajorMatrix signatures = made.signatures;
  Gram gram = gram_of(filter, pool, signatures);
  Solved solution = solved(gram, line, known);
  return {std::move(gram), std::move(solution), signatures, std::move(filter)};
}

// Each gain g of prior N(0, d^2 s^2 / |what is left of its column|^2), known columns of prior N(0, 1) um with the
// scatter s taken as `variance`: all terms of one covariance matrix, s integrated over ds / s.
double by_matrix(const Made& made, const Covariance& covariance, const std::vector<Eigen::Index>& chosen,
                 double known_variance) {
  const Eigen::MatrixXd plain = dense::matrix_of(covariance, made.time_s);
  Eigen::MatrixXd c = plain;
  if (known_variance > 0.0) c += made.known * made.known.transpose() / known_variance;
  const Eigen::MatrixXd columns = made.signatures(Eigen::all, chosen);
  const double nu = static_cast<double>(kN - made.flat.cols());
  if (chosen.empty()) {
    const dense::Flat one = dense::flat(made.y, made.flat, c);
    return dense::log_over_scale(one.square, nu) - one.half_log;
  }
  const Eigen::VectorXd left = dense::left_of(columns, made.flat, c).diagonal();
  std::vector<double> sizes;
  for (const double d : kGainSizes) {
    Eigen::MatrixXd with = c;
    for (Eigen::Index k = 0; k < columns.cols(); ++k)
      with += d * d / left[k] * columns.col(k) * columns.col(k).transpose();
    const dense::Flat one = dense::flat(made.y, made.flat, with);
    sizes.push_back(dense::log_over_scale(one.square, nu) - one.half_log);
  }
  return dense::log_mean(sizes);
}

const std::vector<std::vector<Eigen::Index>>& sets() {
  static const std::vector<std::vector<Eigen::Index>> kSets{{}, {0}, {1}, {2}, {0, 1}, {0, 2}, {1, 2}, {0, 1, 2}};
  return kSets;
}

TEST(Evidence, of_sets_is_the_marginal_likelihood) {
  const Made rows = made();
  for (const Covariance& covariance : {Covariance{}, memory(), with_slow()}) {
    const Weighing found = weighing(rows, covariance, false);
    const double none = found.of({}), none_by_matrix = by_matrix(rows, covariance, {}, 0.0);
    for (const std::vector<Eigen::Index>& set : sets()) {
      EXPECT_NEAR(found.of(set) - none, by_matrix(rows, covariance, set, 0.0) - none_by_matrix, 1e-6)
          << covariance.time_s << " " << set.size();
    }
  }
}

// The constant that is left out is that of nu alone: covariances can be compared.
TEST(Evidence, of_covariances_is_the_marginal_likelihood) {
  const Made rows = made();
  const double white = weighing(rows, {}, false).of({0}), white_by_matrix = by_matrix(rows, {}, {0}, 0.0);
  for (const Covariance& covariance : {memory(), with_slow()}) {
    EXPECT_NEAR(weighing(rows, covariance, false).of({0}) - white,
                by_matrix(rows, covariance, {0}, 0.0) - white_by_matrix, 1e-6);
  }
}

// Known columns: their prior is in um, so that the scatter has to be known for it; it is taken where the model alone
// has it. The same variance in the matrix: 0.1 for what the last of its rounds is short of.
TEST(Evidence, of_known_columns_is_the_marginal_likelihood_at_their_scatter) {
  const Made rows = made();
  for (const Covariance& covariance : {Covariance{}, memory(), with_slow()}) {
    const Weighing found = weighing(rows, covariance, true);
    const double variance = found.solution.variance;
    const double none = found.of({}), none_by_matrix = by_matrix(rows, covariance, {}, variance);
    for (const std::vector<Eigen::Index>& set : sets()) {
      EXPECT_NEAR(found.of(set) - none, by_matrix(rows, covariance, set, variance) - none_by_matrix, 0.1)
          << covariance.time_s << " " << set.size();
    }
    EXPECT_NEAR(none - weighing(rows, covariance, false).of({}), none_by_matrix - by_matrix(rows, covariance, {}, 0.0),
                0.1);
  }
}

// The whole integral over s of both: to 2.5, where an effect takes two thirds of the scatter.
TEST(Evidence, of_known_columns_is_near_the_whole_integral) {
  const Made rows = made();
  const Eigen::MatrixXd scatter = dense::matrix_of(memory(), rows.time_s);
  const auto whole = [&](const std::vector<Eigen::Index>& set) {
    std::vector<double> all;
    for (double log_s = -5.0; log_s < 2.0; log_s += 0.05) {
      const Eigen::MatrixXd c = std::exp(2.0 * log_s) * scatter + rows.known * rows.known.transpose();
      const Eigen::MatrixXd columns = rows.signatures(Eigen::all, set);
      const Eigen::VectorXd left = dense::left_of(columns, rows.flat, c).diagonal();
      std::vector<double> sizes;
      for (const double d : kGainSizes) {
        Eigen::MatrixXd with = c;
        for (Eigen::Index k = 0; k < columns.cols(); ++k)
          with += d * d / left[k] * columns.col(k) * columns.col(k).transpose();
        const dense::Flat one = dense::flat(rows.y, rows.flat, with);
        sizes.push_back(-0.5 * one.square - one.half_log);
      }
      all.push_back(dense::log_mean(sizes));
    }
    return dense::log_mean(all);
  };
  const Weighing found = weighing(rows, memory(), true);
  const double none = whole({});
  for (const std::vector<Eigen::Index>& set : sets())
    EXPECT_NEAR(found.of(set) - found.of({}), whole(set) - none, 2.5) << set.size();
}

// s known beforehand as if by so many readings: s^-(readings + 1) exp(-readings v / 2 s^2), which adds readings to nu
// and readings times v to S.
TEST(Evidence, of_a_known_scatter) {
  const Made rows = made();
  const KnownScatter known{25.0, 0.09};
  const Weighing found = weighing(rows, memory(), false, known);
  const double nu = static_cast<double>(kN - rows.flat.cols());
  const auto by_hand = [&](const Eigen::MatrixXd& c) {
    const dense::Flat one = dense::flat(rows.y, rows.flat, c);
    return dense::log_over_scale(one.square + 25.0 * 0.09, nu + 25.0) - one.half_log;
  };
  const Eigen::MatrixXd c = dense::matrix_of(memory(), rows.time_s);
  const double left = dense::left_of(rows.signatures.col(0), rows.flat, c)(0, 0);
  std::vector<double> sizes;
  for (const double d : kGainSizes) {
    sizes.push_back(by_hand(c + d * d / left * rows.signatures.col(0) * rows.signatures.col(0).transpose()));
  }
  EXPECT_NEAR(found.of({0}) - found.of({}), dense::log_mean(sizes) - by_hand(c), 1e-6);
  EXPECT_NEAR(found.solution.variance, (dense::flat(rows.y, rows.flat, c).square + 2.25) / (nu + 25.0), 1e-9);
}

// Three readings 0, 0, 3 about a constant, white: S = 6, nu = 2. A column (0, 0, 1) / sqrt(2/3) explains all of it:
// left with prior size d: S = 6 / (1 + d^2), so that 2 (ln p with - without) = ln((1 + d^2)^2 / (1 + d^2)) = ln(1 +
// d^2).
TEST(Evidence, three_readings_by_hand) {
  RowMajorMatrix pool(3, 2), signature(3, 1);
  pool << 0, 1, 0, 1, 3, 1;
  signature << 0, 0, 1;
  const CovarianceFilter filter({}, std::vector<double>{0.0, 1.0, 2.0}, {});
  const Solved found = solved(gram_of(filter, pool, signature), {0, {1}, {1}}, {});
  EXPECT_NEAR(found.square, 6.0, 1e-8);
  EXPECT_NEAR(found.degrees, 2.0, 0.0);
  EXPECT_NEAR(found.left[0], 2.0 / 3.0, 1e-9);
  EXPECT_NEAR(found.along[0], 2.0, 1e-8);
  EXPECT_NEAR(found.coefficients[0], 1.0, 1e-9);
  std::vector<double> sizes;
  for (const double d : kGainSizes) sizes.push_back(0.5 * std::log(1.0 + d * d));
  EXPECT_NEAR(log_evidence(found, found.left[0], found.along[0]) - log_evidence(found), dense::log_mean(sizes), 1e-6);
}

TEST(Evidence, one_column_by_its_matrix_is_one_by_its_numbers) {
  const Weighing found = weighing(made(), memory(), true);
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_NEAR(found.of({k}), log_evidence(found.solution, found.solution.left[k], found.solution.along[k]), 1e-9);
  }
}

TEST(Evidence, goes_with_the_unit_of_a_signature_nowhere) {
  Made rows = made();
  const double before = weighing(rows, memory(), true).of({0, 1});
  rows.signatures.col(0) *= 1e6;
  rows.signatures.col(1) *= -1e-6;
  EXPECT_NEAR(weighing(rows, memory(), true).of({0, 1}), before, 1e-6);
}

// All readings in nm: known columns too, their prior is of what a model makes. What is compared stays.
TEST(Evidence, differences_go_with_the_unit_of_the_readings_nowhere) {
  Made rows = made();
  const Weighing um = weighing(rows, with_slow(), true);
  rows.y *= 1000.0;
  rows.known *= 1000.0;
  const Weighing nm = weighing(rows, with_slow(), true);
  for (const std::vector<Eigen::Index>& set : sets()) EXPECT_NEAR(um.of(set) - um.of({}), nm.of(set) - nm.of({}), 1e-6);
}

TEST(Gram, is_the_products_over_the_dense_matrix) {
  const Made rows = made();
  const Weighing found = weighing(rows, with_slow(), false);
  const Eigen::LLT<Eigen::MatrixXd> c(dense::matrix_of(with_slow(), rows.time_s));
  Eigen::MatrixXd pool(kN, 4);
  pool << rows.y, rows.flat;
  const Eigen::MatrixXd among = pool.transpose() * c.solve(pool), with = pool.transpose() * c.solve(rows.signatures),
                        own = rows.signatures.transpose() * c.solve(rows.signatures);
  const double unit = among.cwiseAbs().maxCoeff();
  EXPECT_EQ(found.gram.rows, kN);
  EXPECT_LT((found.gram.pool - among).cwiseAbs().maxCoeff(), 1e-9 * unit);
  EXPECT_LT((found.gram.cross - with).cwiseAbs().maxCoeff(), 1e-9 * unit);
  EXPECT_LT((found.gram.squares - own.diagonal()).cwiseAbs().maxCoeff(), 1e-9 * unit);
  const std::vector<Eigen::Index> chosen{2, 0};
  EXPECT_LT((products_of(found.filter, found.signatures, chosen) - own(chosen, chosen)).cwiseAbs().maxCoeff(),
            1e-9 * unit);
}

TEST(LogSum, of_large_and_of_no_numbers) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(log_sum(std::vector<double>{1000.0, 1000.0}), 1000.0 + std::log(2.0), 1e-12);
  EXPECT_NEAR(log_sum(std::vector<double>{-inf, -3.0}), -3.0, 1e-12);
  EXPECT_EQ(log_sum(std::vector<double>{}), -inf);
  EXPECT_EQ(log_sum(std::vector<double>{-inf, -inf}), -inf);
}

// Two columns that are the same, and one that the others make: no more is known of them than of one.
TEST(Evidence, columns_that_are_the_same_have_an_evidence) {
  Made rows = made();
  const double once = weighing(rows, memory(), false).of({0});
  Eigen::MatrixXd doubled(kN, 4);
  doubled << rows.flat, rows.flat.col(1) - 2.0 * rows.flat.col(0);
  rows.flat = doubled;
  rows.signatures.col(1) = rows.signatures.col(0);
  const Weighing found = weighing(rows, memory(), false);
  EXPECT_TRUE(std::isfinite(found.of({})));
  EXPECT_TRUE(std::isfinite(found.of({0, 1})));
  EXPECT_TRUE(std::isfinite(once));
  EXPECT_NEAR(found.solution.along[0], found.solution.along[1], 1e-6);
}

}  // namespace
}  // namespace ballbar

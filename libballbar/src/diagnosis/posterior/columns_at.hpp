// The columns of all identities at one covariance: white, and freed of the line.
//
// With X the columns, W the filter and P what takes the line off, all that a single effect needs is X' W' P W y
// ("along"), the squares of P W X ("left"), and products of P W X with a curve. Lengths in um, not divided by the
// scatter.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "diagnosis/posterior/identities.hpp"
#include "diagnosis/thresholds.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

// A little of every input in every form: what no single effect is.
struct DenseBackground {
  RowMajorMatrix columns;           // n by K, of deviation 1
  std::vector<std::size_t> family;  // of each column
  double d = 0.0;                   // of all of it together, in units of the scatter; 0: none
};

// Columns of a shape of several gains, or of one identity of several, turned so that they are independent.
struct BlockProduct {
  std::size_t shape = 0;                                   // of Identities::shapes
  double settled = -1.0;                                   // variance of the scatter that the four below are about
  Eigen::MatrixXd vectors;                                 // w by w
  Eigen::VectorXd values;                                  // w: square of each direction, of columns of length 1
  Eigen::VectorXd length;                                  // w: of each column
  std::array<double, kGainSizes.size()> half_log_width{};  // of each size of gains
  Eigen::MatrixXd white;  // w by w: products of the columns before the line is taken off
};

struct ColumnSpan {
  Eigen::Index first = 0, count = 0;
};

class ColumnsAt {
 public:
  // Refers to all but the background.
  ColumnsAt(const Problem& problem, const Identities& identities, const Variant& variant, const Point& point,
            const DenseBackground& background);

  // What is known of the line is in um: it needs the variance of the scatter. Before it `square`, `degrees` and
  // `constant` alone are there, about the scatter that nothing at all leaves.
  void settle(double variance);

  double settled = 0.0;         // variance of the scatter
  double square = 0.0;          // of what is left of the readings
  double degrees = 0.0;         // n less the columns that are free
  double constant = 0.0;        // of ln of the evidence, without the scatter
  Eigen::VectorXd along, left;  // of all columns; left: 0 where too little is left of one
  const BlockProduct& block(std::size_t shape);

  // Of what the background makes of the readings, the share of each family of its columns. line: of the curve of all
  // single effects, which is taken off before.
  std::vector<std::pair<std::size_t, double>> background_shares(const Eigen::VectorXd& line) const;

  // A curve out of some columns, white, and what the line makes of it.
  struct Curve {
    Eigen::VectorXd white, line;
  };
  Curve curve_of(const std::vector<std::pair<Eigen::Index, double>>& coefficients) const;
  // With what is left of some columns: of the others 0.
  Eigen::VectorXd products(const Curve& curve, const std::vector<ColumnSpan>& columns) const;
  double product(const Curve& a, const Curve& b) const { return a.white.dot(b.white) - a.line.dot(b.line); }

 private:
  void solve_line();
  Eigen::MatrixXd solved_beside(const Eigen::Ref<const Eigen::MatrixXd>& products) const;
  void solve_columns();
  void settle_line(double variance);

  const Identities& identities_;
  const Whitening& filter_;
  double log_determinant_ = 0.0, background_d_ = 0.0;
  Eigen::Index line_ = 0;             // columns of the line, the background's behind them
  std::vector<char> is_free_;         // of the line's
  Eigen::MatrixXd pool_, cross_;      // products of y and the line, and of these with all columns
  Eigen::VectorXd squares_;           // of all columns
  std::vector<BlockProduct> blocks_;  // by their shape, rising
  std::vector<std::size_t> family_of_background_;
  Eigen::VectorXd precision_;  // of the background's columns, in units of the scatter

  // The line's columns that no scatter changes, `fixed`, and behind them the open ones, freed of these and turned so
  // that each is by itself: of another scatter they only have another length.
  std::vector<Eigen::Index> fixed_, open_;  // of pool_
  Eigen::VectorXd scale_;                   // of the fixed ones
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::MatrixXd between_, turn_;  // fixed by open; of the open ones
  Eigen::VectorXd values_;          // squares of the open ones
  Eigen::VectorXd solved_y_;
  Eigen::MatrixXd solved_;                    // line by all columns
  Eigen::VectorXd along_fixed_, left_fixed_;  // freed of the fixed ones
  Eigen::VectorXd length_;                    // of `line` over that of solved_
};

}  // namespace ballbar

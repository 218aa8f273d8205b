// The columns of all identities at one covariance: whitened, and made orthogonal to the linear model ("the line").
//
// With X the columns, W the filter and P the projection orthogonal to the line, a single effect only needs
// X' W' P W y ("along"), the squares of P W X ("left"), and products of P W X with a curve. Lengths are in um, not
// divided by the scatter.
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

// The columns of a shape with several gains, rotated so that they are independent.
struct BlockProduct {
  std::size_t shape = 0;                                   // of Identities::shapes
  double settled = -1.0;                                   // variance of the scatter for the four members below
  Eigen::MatrixXd vectors;                                 // w by w
  Eigen::VectorXd values;                                  // w: square of each direction, for columns of length 1
  Eigen::VectorXd length;                                  // w: of each column
  std::array<double, kGainSizes.size()> half_log_width{};  // of each size of gains
  Eigen::MatrixXd white;                                   // w by w: products of the columns before the projection
};

struct ColumnSpan {
  Eigen::Index first = 0, count = 0;
};

class ColumnsAt {
 public:
  // Keeps references to all arguments.
  ColumnsAt(const Problem& problem, const Identities& identities, const Variant& variant, const Point& point);

  // Sets the variance of the scatter, because the priors of the line are in um. Before this call only `square`,
  // `degrees` and `constant` are valid, for the scatter without any effect.
  void settle(double variance);

  double settled = 0.0;         // variance of the scatter
  double square = 0.0;          // residual sum of squares of the readings
  double degrees = 0.0;         // n minus the number of free columns
  double constant = 0.0;        // part of ln of the evidence without the scatter
  Eigen::VectorXd along, left;  // per column; left: 0 if too little of the column remains
  const BlockProduct& block(std::size_t shape);

  // A whitened combination of columns, with the part that the line absorbs.
  struct Curve {
    Eigen::VectorXd white, line;
  };
  Curve curve_of(const std::vector<std::pair<Eigen::Index, double>>& coefficients) const;
  // Products of the curve with the remaining parts of some columns; 0 for the others.
  Eigen::VectorXd products(const Curve& curve, const std::vector<ColumnSpan>& columns) const;
  double product(const Curve& a, const Curve& b) const { return a.white.dot(b.white) - a.line.dot(b.line); }

 private:
  void solve_line();
  Eigen::MatrixXd solved_beside(const Eigen::Ref<const Eigen::MatrixXd>& products) const;
  void solve_columns();
  void settle_line(double variance);

  const Identities& identities_;
  const Whitening& filter_;
  double log_determinant_ = 0.0;
  Eigen::Index line_ = 0;             // columns of the line
  std::vector<char> is_free_;         // of the line's
  Eigen::MatrixXd pool_, cross_;      // products of y and the line with each other, and with all columns
  Eigen::VectorXd squares_;           // of all columns
  std::vector<BlockProduct> blocks_;  // by their shape, rising

  // The columns of the line with flat priors (`fixed`), followed by those with normal priors (`open`). The open ones
  // are made orthogonal to the fixed ones and to each other, so that another scatter only changes their lengths.
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

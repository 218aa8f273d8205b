// The columns of all identities at one covariance: whitened, and made orthogonal to the linear model.
//
// With X the columns, W the filter and P the projection orthogonal to the model, a single effect only needs
// X' W' P W y ("along"), the squares of P W X ("left"), and products of P W X with a curve. Lengths are in um, not
// divided by the scatter.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "diagnosis/evidence/linear_model.hpp"
#include "diagnosis/posterior/identities.hpp"
#include "diagnosis/signatures/thresholds.hpp"
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

class ProjectedColumns {
 public:
  // Keeps references to the identities and to the filter.
  ProjectedColumns(const Problem& problem, const Identities& identities, const LinearModel& model,
                   const NoiseFilter& filter);

  // Sets the variance of the scatter, because the priors of the model are in um. At first it is that without any
  // effect.
  void settle(double variance);

  double settled = 0.0;         // variance of the scatter
  double square = 0.0;          // residual sum of squares of the readings
  double degrees = 0.0;         // n minus the number of flat columns
  double constant = 0.0;        // part of ln of the evidence without the scatter
  Eigen::VectorXd along, left;  // per column; left: 0 if too little of the column remains
  const BlockProduct& block(std::size_t shape);

  // A whitened combination of columns, with the part that the model explains.
  struct Curve {
    Eigen::VectorXd white, explained;
  };
  Curve curve_of(const std::vector<std::pair<Eigen::Index, double>>& coefficients) const;
  // Products of the curve with the remaining parts of some columns; 0 for the others.
  Eigen::VectorXd products(const Curve& curve, const std::vector<ColumnSpan>& columns) const;
  double product(const Curve& a, const Curve& b) const { return a.white.dot(b.white) - a.explained.dot(b.explained); }

 private:
  const Identities& identities_;
  const Whitening& whitening_;
  std::vector<char> is_flat_;
  Gram gram_;                         // of the model
  Eigen::MatrixXd cross_;             // 1 + p by all columns: products of y and the model with them
  Eigen::VectorXd squares_;           // of all columns
  std::vector<BlockProduct> blocks_;  // by their shape, rising
  Eigen::MatrixXd explained_;         // p by all columns
};

}  // namespace ballbar

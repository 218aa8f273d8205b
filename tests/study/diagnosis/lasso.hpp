// Least absolute shrinkage and selection with its penalty by cross-validation.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ballbar::study {

// Columns (n by p, of unit length or 0) with a coefficient that is not 0: minimises |y - X b|^2 / 2 + lambda |b|_1 by
// coordinate descent along 30 penalties from the least that leaves nothing down to its hundredth part; the penalty is
// the largest whose error on five stretches left out is within one standard error of the least. Source: J. Friedman, T.
// Hastie, R. Tibshirani, Regularization paths for generalized linear models via coordinate descent, J. Stat. Softw. 33
// (2010).
std::vector<Eigen::Index> lasso_selection(const Eigen::MatrixXd& x, const Eigen::VectorXd& y);

}  // namespace ballbar::study

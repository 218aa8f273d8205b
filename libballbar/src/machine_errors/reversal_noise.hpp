// Rows near a reversal: the form of a spike is never quite that of the model, and what is left there is no noise.
#pragma once

#include <Eigen/Core>

#include "machine_errors/error_rows.hpp"

namespace ballbar {

// Rows beyond the reach of a reversal, two of a recording joined to one, with the means of columns: what the noise is
// learnt from.
struct QuietRows {
  ErrorRows rows;
  Eigen::MatrixXd columns;
};
QuietRows quiet_rows(const ErrorRows& rows, const Eigen::MatrixXd& columns);

// By how much the readings within the reach of each reversal scatter more than those of none, a factor for each row; 1
// where that is not clear.
Eigen::VectorXd excess_of(const ErrorRows& rows, const Eigen::VectorXd& residual);

}  // namespace ballbar

#include "whitened.hpp"

namespace ballbar {

Eigen::MatrixXd whitened(const Whitening& whitening, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd out(columns.rows(), columns.cols());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) whitening.apply(columns.col(k).data(), 1, out.col(k).data(), 1);
  return out;
}

}  // namespace ballbar

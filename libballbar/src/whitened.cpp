#include "whitened.hpp"

#include <algorithm>
#include <vector>

namespace ballbar {

Eigen::MatrixXd whitened(const Whitening& whitening, const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  // The filter goes from row to row; columns beside one another fill the time that each step has to wait.
  constexpr Eigen::Index kTogether = 8, kBlockRows = 256;
  const Eigen::Index n = columns.rows();
  Eigen::MatrixXd out(n, columns.cols());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> block(std::min(kBlockRows, n), kTogether);
  Eigen::Index k = 0;
  for (; k + kTogether <= columns.cols(); k += kTogether) {
    Eigen::RowVectorXd state = Eigen::RowVectorXd::Zero(kTogether);
    for (Eigen::Index first = 0; first < n; first += kBlockRows) {
      auto part = block.topRows(std::min(kBlockRows, n - first));
      part = columns.block(first, k, part.rows(), kTogether);
      whitening.apply(static_cast<std::size_t>(first), part, state);
      out.block(first, k, part.rows(), kTogether) = part;
    }
  }
  for (; k < columns.cols(); ++k) whitening.apply(columns.col(k).data(), 1, out.col(k).data(), 1);
  return out;
}

Eigen::VectorXd clipped(Eigen::VectorXd white) {
  constexpr double kMost = 4.0, kSigmaOfDeviation = 1.4826;
  if (white.size() == 0) return white;
  const auto median = [](std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  const double centre = median({white.begin(), white.end()});
  std::vector<double> deviation;
  deviation.reserve(static_cast<std::size_t>(white.size()));
  for (const double value : white) deviation.push_back(std::abs(value - centre));
  const double most = kMost * kSigmaOfDeviation * median(std::move(deviation));
  if (!(most > 0.0)) return white;  // half of them the same
  for (double& value : white) value = std::clamp(value, centre - most, centre + most);
  return white;
}

}  // namespace ballbar

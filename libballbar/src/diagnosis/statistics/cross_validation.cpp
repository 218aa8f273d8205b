#include "diagnosis/statistics/cross_validation.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

// A row more for each column of limited reach: that its factor is nothing, give or take the reach. What the rows do not
// tell of a shape stays as it is.
Eigen::MatrixXd with_reach(const Eigen::MatrixXd& white, const std::vector<Eigen::Index>& columns,
                           const std::vector<double>& reach_um) {
  if (reach_um.empty()) return white;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(white.rows() + white.cols(), white.cols());
  all.topRows(white.rows()) = white;
  for (Eigen::Index k = 0; k < white.cols(); ++k) {
    const double reach = reach_um[static_cast<std::size_t>(columns[static_cast<std::size_t>(k)])];
    all(white.rows() + k, k) = 1.0 / std::max(reach, kLeastReach_um);
  }
  return all;
}

}  // namespace

CrossValidation cross_validation(const LinearisedFit& linearised, const Noise& noise,
                                 const std::vector<std::size_t>& fold, bool of_recordings) {
  const std::size_t folds = *std::max_element(fold.begin(), fold.end()) + 1;
  CrossValidation result;
  for (std::size_t out = 0; out < folds; ++out) {
    std::vector<Eigen::Index> kept, left;
    LinearisedFit rest, own;
    for (std::size_t i = 0; i < fold.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (fold[i] == out) {
        left.push_back(row);
        own.time_s.push_back(linearised.time_s[i]);
        if (!linearised.sigma_um.empty()) own.sigma_um.push_back(linearised.sigma_um[i]);
        continue;
      }
      kept.push_back(row);
      rest.time_s.push_back(linearised.time_s[i]);
      if (!linearised.sigma_um.empty()) rest.sigma_um.push_back(linearised.sigma_um[i]);
    }
    std::vector<Eigen::Index> shared, of_its_own;
    for (Eigen::Index j = 0; j < linearised.model.cols(); ++j) {
      const bool elsewhere =
          linearised.model(kept, j).squaredNorm() > kNotInTheseRows * linearised.model.col(j).squaredNorm();
      (elsewhere || !of_recordings ? shared : of_its_own).push_back(j);
    }
    Eigen::VectorXd error = linearised.residual_um(left);
    const Whitening whitening(noise, rest.time_s, rest.sigma_um), own_whitening(noise, own.time_s, own.sigma_um);
    const auto free_of = [&](const std::vector<Eigen::Index>& columns, const Eigen::MatrixXd& white,
                             const Eigen::VectorXd& white_r) {
      if (columns.empty() || white.rows() == 0) return;
      const Eigen::MatrixXd x = with_reach(white, columns, linearised.reach_um);
      Eigen::VectorXd r = Eigen::VectorXd::Zero(x.rows());
      r.head(white_r.size()) = white_r;
      Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
      solver.setThreshold(kTold);
      solver.compute(x);
      error -= linearised.model(left, columns) * solver.solve(r);
    };
    free_of(shared, whitened(whitening, linearised.model(kept, shared)),
            whitened(whitening, linearised.residual_um(kept)));
    free_of(of_its_own, whitened(own_whitening, linearised.model(left, of_its_own)), whitened(own_whitening, error));
    result.rmse_um += error.squaredNorm();
    result.chi2 += whitened(own_whitening, error).squaredNorm();
  }
  result.rmse_um = std::sqrt(result.rmse_um / static_cast<double>(fold.size()));
  return result;
}

}  // namespace ballbar

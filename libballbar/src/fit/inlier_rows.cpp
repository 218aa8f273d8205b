#include "fit/inlier_rows.hpp"

#include <algorithm>

namespace ballbar {
namespace {

template <class Use>
void for_each_kept(std::size_t n, const std::vector<std::size_t>& discounted, Use use) {
  auto next = discounted.begin();
  for (std::size_t row = 0; row < n; ++row) {
    if (next != discounted.end() && *next == row) {
      ++next;
    } else {
      use(row);
    }
  }
}

template <class Value>
std::vector<Value> kept(const std::vector<Value>& values, const std::vector<std::size_t>& discounted) {
  std::vector<Value> result;
  result.reserve(values.size());
  for_each_kept(values.size(), discounted, [&](std::size_t row) { result.push_back(values[row]); });
  return result;
}

}  // namespace

std::vector<double> without(const std::vector<double>& values, const std::vector<std::size_t>& discounted) {
  return kept(values, discounted);
}

Eigen::MatrixXd without(const Eigen::MatrixXd& rows, const std::vector<std::size_t>& discounted) {
  if (discounted.empty()) return rows;
  std::vector<Eigen::Index> index;
  for_each_kept(static_cast<std::size_t>(rows.rows()), discounted,
                [&](std::size_t row) { index.push_back(static_cast<Eigen::Index>(row)); });
  return rows(index, Eigen::all);
}

Fit inliers_of(const Fit& fit) {
  Fit result;
  result.target = fit.target;
  result.time_s = kept(fit.time_s, fit.discounted);
  result.row = kept(fit.row, fit.discounted);
  result.residual_um = kept(fit.residual_um, fit.discounted);
  result.sigma_um = kept(fit.sigma_um, fit.discounted);
  result.noise = fit.noise;
  result.floor = fit.floor;
  result.rmse_um = fit.rmse_um;
  return result;
}

}  // namespace ballbar

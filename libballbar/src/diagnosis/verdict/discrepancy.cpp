#include "diagnosis/verdict/discrepancy.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "diagnosis/posterior/linearisation.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

// Adds to each row i the sum of k(t_i - t_j) z_j over the rows j before it in this order. The kernel k is e^-d of a
// rough discrepancy, (1 + d) e^-d of a smooth one, d = rate |dt|.
template <class Row>
void add_sums(const std::vector<double>& time_s, double rate, bool is_rough, const Eigen::VectorXd& z, Row&& row,
              Eigen::VectorXd& sums) {
  double plain = 0.0, with_distance = 0.0;  // sums of e^-d z and d e^-d z
  const Eigen::Index n = z.size();
  for (Eigen::Index k = 1; k < n; ++k) {
    const Eigen::Index now = row(k), last = row(k - 1);
    plain += z[last];
    // Time goes back between runs: nothing goes on.
    const Eigen::Index later = std::max(now, last), earlier = std::min(now, last);
    const double step_s = time_s[static_cast<std::size_t>(later)] - time_s[static_cast<std::size_t>(earlier)];
    if (step_s < 0.0) plain = with_distance = 0.0;
    const double d = rate * std::max(step_s, 0.0), kept = std::exp(-d);
    with_distance = kept * (with_distance + d * plain);
    plain *= kept;
    sums[now] += is_rough ? plain : plain + with_distance;
  }
}

}  // namespace

Eigen::VectorXd discrepancy_mean(const Problem& problem, const Posterior& posterior, const EffectSet& set) {
  const auto slow = std::find_if(posterior.filters.begin(), posterior.filters.end(),
                                 [](const NoiseFilter& one) { return one.covariance.slow > 0.0; });
  const bool is_elsewhere = posterior.discrepancy >= kDiscrepancy && slow != posterior.filters.end() &&
                            !(posterior.filters[set.filter].covariance.slow > 0.0);
  const NoiseFilter& filter = is_elsewhere ? *slow : posterior.filters[set.filter];
  const Covariance& covariance = filter.covariance;
  const Eigen::Index n = problem.y.size();
  if (!(covariance.slow > 0.0)) return Eigen::VectorXd::Zero(n);
  const LinearModel linear =
      with_signatures(problem, posterior.linearisations[set.linearisation].linear, set.signatures);
  RowMajorMatrix white(n, 1);
  white.col(0) = residual_of(linear, linear_solution(filter.whitening, linear, problem.known));
  const Eigen::VectorXd z = filter.whitening.transposed(whitened_rows(filter.whitening, std::move(white))).col(0);
  const double rate = (covariance.slow_is_rough ? 1.0 : std::sqrt(3.0)) / covariance.slow_time_s;
  Eigen::VectorXd sums = z;
  add_sums(
      problem.time_s, rate, covariance.slow_is_rough, z, [](Eigen::Index k) { return k; }, sums);
  add_sums(
      problem.time_s, rate, covariance.slow_is_rough, z, [n](Eigen::Index k) { return n - 1 - k; }, sums);
  return covariance.slow * sums;
}

Description description_of(const Catalogue& catalogue, const Problem& problem, const Eigen::VectorXd& discrepancy_um) {
  Catalogue of_time;
  std::copy_if(catalogue.begin(), catalogue.end(), std::back_inserter(of_time),
               [](const auto& effect) { return describes_drift(*effect); });
  Model constant;
  constant.targets = problem.model.targets;
  const SignatureLibrary library =
      signature_library_of(of_time, constant, problem.logged.series, problem.base, SignatureOptions{});
  const Eigen::VectorXd centred = discrepancy_um.array() - discrepancy_um.mean();
  double most = problem.tuning.follows;
  Description best;
  for (const Signature& one : library.signatures) {
    Eigen::MatrixXd columns = library.columns.middleCols(one.first, one.width);
    columns.rowwise() -= columns.colwise().mean();
    const double left = orthogonal_part(centred, orthonormal(columns)).squaredNorm();
    const double r2 = 1.0 - left / std::max(centred.squaredNorm(), 1e-300);
    if (!(r2 > most + 0.005)) continue;
    most = r2;
    const Effect& effect = *library.families[one.family].bound.effect;
    best = {effect.name, "", 0.0};
    for (std::size_t k = 0; k < one.point.size(); ++k) {
      const Parameter& parameter = effect.parameters[k];
      if (parameter.kind != ParameterKind::shape || parameter.unit != "s") continue;
      best.parameter = parameter.name.substr(0, parameter.name.rfind('_'));
      std::replace(best.parameter.begin(), best.parameter.end(), '_', ' ');
      best.time_s = one.point[k];
    }
  }
  return best;
}

}  // namespace ballbar

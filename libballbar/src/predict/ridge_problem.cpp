#include <algorithm>
#include <cmath>

#include "predict/ridge.hpp"

namespace ballbar {
namespace {

// Every k-th row of each run, its first one always; of more runs than half of `most` every k-th row of all.
std::vector<std::size_t> thinned_by_run(const Design& design, const std::vector<std::size_t>& rows, std::size_t most) {
  if (2 * design.runs > most) return thinned(rows, most);
  const std::size_t step = std::max<std::size_t>(1, (rows.size() + most - 1) / most);
  std::vector<std::size_t> kept;
  std::size_t first = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (design.run[rows[i]] != design.run[rows[first]]) first = i;
    if ((i - first) % step == 0) kept.push_back(rows[i]);
  }
  return kept;
}

}  // namespace

RidgeProblem ridge_problem(const Design& design, const std::vector<std::size_t>& rows, std::size_t most) {
  const std::vector<std::size_t> kept = thinned_by_run(design, rows, most);
  const auto n = static_cast<Eigen::Index>(kept.size());
  const Eigen::Index p = design.values.cols();
  RidgeProblem problem;
  problem.columns = design.values(kept, Eigen::all);
  problem.target_um.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t row = kept[static_cast<std::size_t>(i)];
    problem.target_um[i] = design.target_um[static_cast<Eigen::Index>(row)];
    problem.time_s.push_back(design.time_s[row]);
    problem.run.push_back(design.run[row]);
  }
  problem.end_s = design.time_s[rows.back()];
  problem.mean = problem.columns.colwise().mean();
  problem.sd.resize(p);
  for (Eigen::Index k = 0; k < p; ++k) {
    const auto column = problem.columns.col(k).array();
    const double sd = std::sqrt((column - problem.mean[k]).square().sum() / static_cast<double>(n));
    problem.sd[k] = sd > 1e-6 * std::max(1e-3, column.abs().maxCoeff()) ? sd : 0.0;
  }
  std::vector<std::size_t> still;  // of the prior, which has a gain for it all the same
  if (design.prior) {
    for (std::size_t t = 0; t < design.prior->at.size(); ++t) {
      double& sd = problem.sd[static_cast<Eigen::Index>(design.prior->at[t])];
      if (sd > 0.0) continue;
      sd = design.prior->sd[static_cast<Eigen::Index>(t)];
      still.push_back(design.prior->at[t]);
    }
  }
  problem.columns.rowwise() -= problem.mean.transpose();
  for (Eigen::Index k = 0; k < p; ++k) {
    if (problem.sd[k] > 0.0) {
      problem.columns.col(k) /= problem.sd[k];
    } else {
      problem.columns.col(k).setZero();
    }
  }
  const auto sd_of = [&](const auto& column) { return std::sqrt(column.squaredNorm() / static_cast<double>(n)); };
  problem.prior.resize(kPredictorKinds);
  for (const PredictorFamily& family : design.predictors.families) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(p, p);
    double weights = 0.0;
    // Exponents of a source have units of their own: no standard deviation of one beside that of another.
    const bool by_sd = family.kind == PredictorKind::temperature || family.kind == PredictorKind::difference;
    for (const PredictorSum& member : family.members) {
      const auto a = static_cast<Eigen::Index>(member.plus);
      if (!member.minus) {
        if (!(problem.sd[a] > 0.0)) continue;
        const double weight = by_sd ? problem.sd[a] : 1.0;
        sum(a, a) += weight;
        weights += weight;
      } else {
        const auto b = static_cast<Eigen::Index>(*member.minus);
        if (!(problem.sd[a] > 0.0) || !(problem.sd[b] > 0.0)) continue;
        const double sd = sd_of(problem.sd[a] * problem.columns.col(a) - problem.sd[b] * problem.columns.col(b));
        if (!(sd > 1e-3 * std::max(problem.sd[a], problem.sd[b]))) continue;
        const double plus = problem.sd[a] / sd, minus = problem.sd[b] / sd, weight = by_sd ? sd : 1.0;
        sum(a, a) += weight * plus * plus;
        sum(b, b) += weight * minus * minus;
        sum(a, b) -= weight * plus * minus;
        sum(b, a) -= weight * plus * minus;
        weights += weight;
      }
    }
    if (!(weights > 0.0)) continue;
    Eigen::MatrixXd& prior = problem.prior[static_cast<std::size_t>(family.kind)];
    if (prior.size() == 0) prior = Eigen::MatrixXd::Zero(p, p);
    prior += sum / weights;
  }
  for (const std::size_t k : design.predictors.named) {
    if (problem.sd[static_cast<Eigen::Index>(k)] > 0.0) problem.named.push_back(k);
  }
  if (design.prior) {
    const GainPrior& prior = *design.prior;
    const Eigen::VectorXd sd = problem.sd(prior.at);
    problem.start = Eigen::VectorXd::Zero(p);
    problem.start_covariance = Eigen::MatrixXd::Zero(p, p);
    for (std::size_t i = 0; i < prior.at.size(); ++i) {  // a term may stand there twice: named, and among all
      const auto k = static_cast<Eigen::Index>(i), row = static_cast<Eigen::Index>(prior.at[i]);
      problem.start[row] += prior.mean[k] * sd[k];
      for (std::size_t j = 0; j < prior.at.size(); ++j) {
        const auto l = static_cast<Eigen::Index>(j);
        problem.start_covariance(row, static_cast<Eigen::Index>(prior.at[j])) += sd[k] * prior.covariance(k, l) * sd[l];
      }
    }
    problem.start_sigma_um = prior.sigma_um;
    // These rows do not tell the gain of what stands still: it is that of the other machines.
    for (const std::size_t k : still) {
      const auto at = static_cast<Eigen::Index>(k);
      const double variance = problem.start_covariance(at, at);
      problem.start_covariance.row(at).setZero();
      problem.start_covariance.col(at).setZero();
      problem.start_covariance(at, at) = variance;
    }
    problem.target_um -= problem.columns * problem.start;
  }
  return problem;
}

}  // namespace ballbar

#include "diagnosis/posterior/ibss.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/posterior/hyperparameters.hpp"

namespace ballbar {
namespace {

constexpr double kSurelyThere = 0.95;  // P of a single effect
constexpr double kHeldSize = 1e-6;     // of a curve's square: how firmly its size stays

// The mean curve of all single effects but one. All are summed if `without` is the index of none.
ProjectedColumns::Curve sum_of(const std::vector<SingleEffect>& effects, const ProjectedColumns& at,
                               std::size_t without) {
  ProjectedColumns::Curve sum = at.curve_of({});
  for (std::size_t l = 0; l < effects.size(); ++l) {
    if (l == without) continue;
    sum.white += effects[l].curve.white;
    sum.explained += effects[l].curve.explained;
  }
  return sum;
}

double along_of(const SingleEffect& effect, const ProjectedColumns& at) {
  double sum = 0.0;
  for (const auto& [column, coefficient] : effect.mean) sum += coefficient * at.along[column];
  return sum;
}

// Expected residual sum of squares of the readings.
double square_left(const std::vector<SingleEffect>& effects, const ProjectedColumns& at, double variance) {
  const ProjectedColumns::Curve all = sum_of(effects, at, effects.size());
  double result = at.square + at.product(all, all);
  for (const SingleEffect& one : effects)
    result += variance * one.expected_square - at.product(one.curve, one.curve) - 2.0 * along_of(one, at);
  return std::max(result, 1e-12 * at.square + 1e-300);
}

double elbo_of(const SumOfEffects& sum, const ProjectedColumns& at, const KnownScatter& known) {
  double elbo = at.constant - 0.5 * (at.degrees + known.readings) * std::log(sum.variance) -
                0.5 * (square_left(sum.effects, at, sum.variance) + known.readings * known.variance) / sum.variance;
  for (const SingleEffect& one : sum.effects) elbo -= one.kl;
  return elbo;
}

const SinglePrior& prior_of(const IbssOptions& options, std::size_t l) {
  return options.priors[std::min(l, options.priors.size() - 1)];
}

void fit_again(ProjectedColumns& at, const Identities& identities, const IdentitySubset& among,
               const SinglePrior& prior, SumOfEffects& sum, std::size_t l) {
  Eigen::VectorXd r = at.along;
  if (sum.effects.size() > 1) r -= at.products(sum_of(sum.effects, at, l), among.columns);
  sum.effects[l] = single_effect_regression(at, identities, among, prior, r, sum.variance);
}

// Variance of the scatter from the residual of the single effects.
double scatter_of(const ProjectedColumns& at, const IbssOptions& options, const SumOfEffects& sum) {
  const KnownScatter& known = options.known;
  const double left = square_left(sum.effects, at, sum.variance) + known.readings * known.variance;
  return std::max(left / (at.degrees + known.readings), options.least_variance);
}

void settle(ProjectedColumns& at, SumOfEffects& sum, double variance) {
  sum.variance = variance;
  at.settle(variance);
  for (SingleEffect& one : sum.effects) one.curve = at.curve_of(one.mean);
}

void sweep(ProjectedColumns& at, const Identities& identities, const IdentitySubset& among, const IbssOptions& options,
           SumOfEffects& sum) {
  for (std::size_t l = 0; l < sum.effects.size(); ++l) fit_again(at, identities, among, prior_of(options, l), sum, l);
}

// The sizes of the single effects that are there, by least squares together: where their curves are alike coordinate
// ascent would find them in hundreds of sweeps. What the readings do not tell stays as it is.
void fit_sizes(const ProjectedColumns& at, SumOfEffects& sum) {
  std::vector<SingleEffect*> there;
  ProjectedColumns::Curve rest = at.curve_of({});
  for (SingleEffect& one : sum.effects) {
    if (one.p_any() >= kSurelyThere) {
      there.push_back(&one);
    } else {
      rest.white += one.curve.white;
      rest.explained += one.curve.explained;
    }
  }
  const auto count = static_cast<Eigen::Index>(there.size());
  if (count < 2) return;
  Eigen::MatrixXd products(count, count);
  Eigen::VectorXd along(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const SingleEffect& one = *there[static_cast<std::size_t>(k)];
    for (Eigen::Index j = 0; j <= k; ++j)
      products(k, j) = products(j, k) = at.product(one.curve, there[static_cast<std::size_t>(j)]->curve);
    along[k] = along_of(one, at) - at.product(one.curve, rest);
  }
  const Eigen::VectorXd held = kHeldSize * products.diagonal().cwiseMax(1e-300);
  products.diagonal() += held;
  const Eigen::VectorXd factor = products.ldlt().solve(along + held);
  if (!factor.allFinite()) return;
  for (Eigen::Index k = 0; k < count; ++k) {
    SingleEffect& one = *there[static_cast<std::size_t>(k)];
    for (auto& [column, coefficient] : one.mean) coefficient *= factor[k];
    one.curve.white *= factor[k];
    one.curve.explained *= factor[k];
  }
}

// Identities that no prior of a single effect forbids.
IdentitySubset all_of(const Identities& identities, const IbssOptions& options) {
  std::vector<char> is_chosen(identities.log_prior.size(), 0);
  for (const SinglePrior& prior : options.priors) {
    for (std::size_t i = 0; i < is_chosen.size(); ++i)
      if (prior.log_identity[i] > kLogZero) is_chosen[i] = 1;
  }
  return subset_of(identities, is_chosen);
}

// Sweeps until the bound stops rising and the scatter stays. The columns are projected again when it has moved far.
void converge(ProjectedColumns& at, const Identities& identities, const IdentitySubset& all, const IbssOptions& options,
              SumOfEffects& sum) {
  double last = kLogZero;
  for (int n = 0; n < options.tuning.most_sweeps; ++n) {
    if (n > 0) fit_sizes(at, sum);
    sweep(at, identities, all, options, sum);
    const double next = scatter_of(at, options, sum);
    const bool same = std::abs(std::log(next / sum.variance)) < options.tuning.same_scatter;
    sum.variance = next;
    if (std::abs(std::log(next / at.settled)) > options.tuning.settled) {
      settle(at, sum, next);
      last = kLogZero;
      continue;
    }
    sum.elbo = elbo_of(sum, at, options.known);
    if (same && sum.elbo - last < options.tuning.rises) break;
    last = sum.elbo;
  }
}

void add_empty(const ProjectedColumns& at, SumOfEffects& sum) {
  sum.effects.emplace_back();
  sum.effects.back().curve = at.curve_of({});
}

}  // namespace

SumOfEffects ibss(ProjectedColumns& at, const Identities& identities, const IbssOptions& options, SumOfEffects start) {
  SumOfEffects sum = std::move(start);
  if (!(sum.variance > 0.0)) {
    sum.variance =
        (at.square + options.known.readings * options.known.variance) / (at.degrees + options.known.readings);
  }
  settle(at, sum, std::max(sum.variance, options.least_variance));
  while (sum.effects.size() < options.least) add_empty(at, sum);
  const IdentitySubset all = all_of(identities, options);
  converge(at, identities, all, options, sum);
  while (sum.effects.size() < options.largest) {
    if (sum.effects.size() > options.least && sum.effects.back().p_any() < 0.5) break;
    add_empty(at, sum);
    const std::size_t next = sum.effects.size() - 1;
    fit_again(at, identities, all, prior_of(options, next), sum, next);
    if (sum.effects.size() > options.least && sum.effects.back().p_any() < options.tuning.hardly_there) break;
    converge(at, identities, all, options, sum);
  }
  settle(at, sum, sum.variance);
  sweep(at, identities, all, options, sum);
  sum.elbo = elbo_of(sum, at, options.known);
  return sum;
}

IbssOptions ibss_options(const Problem& problem, const Identities& identities, std::size_t largest, Forms forms) {
  IbssOptions options;
  SinglePrior prior{std::log(problem.tuning.none), identities.log_prior};
  for (double& one : prior.log_identity) one += std::log1p(-problem.tuning.none);
  for (std::size_t i = problem.effects; i < identities.families && forms == Forms::no; ++i)
    prior.log_identity[i] = kLogZero;
  options.priors = {std::move(prior)};
  options.largest = largest;
  options.known = problem.known;
  options.tuning = problem.tuning;
  options.least_variance = least_variance_of(problem);
  return options;
}

IbssOptions with_exactly(IbssOptions options, const std::vector<std::size_t>& set) {
  const std::size_t count = options.priors.front().log_identity.size();
  options.least = options.largest = set.size();
  options.priors.assign(set.size(), {kLogZero, std::vector<double>(count, kLogZero)});
  for (std::size_t l = 0; l < set.size(); ++l) options.priors[l].log_identity[set[l]] = 0.0;
  return options;
}

SumOfEffects sum_at(const Problem& problem, const Identities& identities, const LinearModel& linear,
                    const Covariance& covariance, const IbssOptions& options, SumOfEffects start) {
  const NoiseFilter filter = noise_filter_at(problem, covariance);
  ProjectedColumns at(problem, identities, linear, filter);
  return ibss(at, identities, options, std::move(start));
}

std::size_t likeliest_identity(const SingleEffect& one) {
  return static_cast<std::size_t>(std::max_element(one.alpha.begin(), one.alpha.end()) - one.alpha.begin());
}

std::vector<std::size_t> likeliest_set(const SumOfEffects& sum) {
  std::vector<std::size_t> set;
  for (const SingleEffect& one : sum.effects) {
    if (one.p_any() >= 0.5) set.push_back(likeliest_identity(one));
  }
  return set;
}

std::vector<std::size_t> sorted_set(const SumOfEffects& sum) {
  std::vector<std::size_t> set = likeliest_set(sum);
  std::sort(set.begin(), set.end());
  return set;
}

std::vector<double> inclusion_probabilities(const SumOfEffects& sum, std::size_t identities) {
  std::vector<double> p(identities, 1.0);
  for (std::size_t i = 0; i < identities; ++i) {
    for (const SingleEffect& one : sum.effects) p[i] *= std::max(0.0, 1.0 - one.alpha[i]);
    p[i] = 1.0 - p[i];
  }
  return p;
}

Covariance covariance_beside(const Problem& problem, const SumOfEffects& sum, const Identities& identities,
                             const LinearModel& linear, const Covariance& start) {
  if (!problem.covariances.empty()) return start;
  return likeliest_covariance(problem, less_mean_of(sum, identities, linear), discrepancy_of(start), &start);
}

LinearModel less_mean_of(const SumOfEffects& sum, const Identities& identities, LinearModel linear) {
  std::vector<std::pair<Eigen::Index, double>> mean;
  for (const SingleEffect& one : sum.effects) mean.insert(mean.end(), one.mean.begin(), one.mean.end());
  linear.columns.col(0) -= combination_of(identities, mean);
  return linear;
}

}  // namespace ballbar

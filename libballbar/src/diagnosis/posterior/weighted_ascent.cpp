#include "diagnosis/posterior/weighted_ascent.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {
void sort_by_weight(std::vector<WeightedAscent>& found) {
  std::stable_sort(found.begin(), found.end(),
                   [](const WeightedAscent& a, const WeightedAscent& b) { return a.log_weight > b.log_weight; });
}

AscentOptions ascent_options(const Problem& problem, const Identities& identities, std::size_t largest, Forms forms,
                             std::size_t without) {
  AscentOptions options;
  SinglePrior prior{std::log(kPriorOfNone), identities.log_prior};
  for (double& one : prior.log_identity) one += std::log1p(-kPriorOfNone);
  if (without != kNoSignature) prior.log_identity[without] = kLogZero;
  for (std::size_t i = problem.effects; i < identities.families && (forms == Forms::no || !problem.tuning.any_forms);
       ++i)
    prior.log_identity[i] = kLogZero;
  options.priors = {std::move(prior)};
  options.largest = largest;
  options.known = problem.known;
  options.least_variance = least_variance_of(problem);
  return options;
}

Ascent ascended_from(ColumnsAt& at, const Identities& identities, const AscentOptions& options,
                     const std::vector<std::size_t>& set) {
  AscentOptions pinned = options;
  pinned.least = pinned.largest = set.size();
  pinned.priors.clear();
  for (const std::size_t i : set) {
    SinglePrior prior{kLogZero, std::vector<double>(identities.log_prior.size(), kLogZero)};
    prior.log_identity[i] = options.priors.front().log_identity[i];
    pinned.priors.push_back(std::move(prior));
  }
  if (set.empty()) return ascended(at, identities, options);
  return ascended(at, identities, options, ascended(at, identities, pinned));
}

std::size_t likeliest_identity(const SingleEffect& one) {
  return static_cast<std::size_t>(std::max_element(one.p.begin(), one.p.end()) - one.p.begin());
}

std::vector<std::size_t> likeliest_set(const Ascent& ascent) {
  std::vector<std::size_t> set;
  for (const SingleEffect& one : ascent.effects) {
    if (one.p_any() >= 0.5) set.push_back(likeliest_identity(one));
  }
  return set;
}

Variant beside_mean_of(const Ascent& ascent, const Identities& identities, Variant variant) {
  const Eigen::Index n = identities.columns.rows(), c = identities.columns.cols();
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(n), jumps = mean;
  for (const SingleEffect& one : ascent.effects) {
    for (const auto& [column, coefficient] : one.mean) {
      if (column < c) {
        mean += coefficient * identities.columns.col(column);
      } else {
        jumps[column - c] += coefficient;
      }
    }
  }
  std::partial_sum(jumps.begin(), jumps.end(), jumps.begin());
  variant.pool.col(0) -= mean + jumps;
  return variant;
}

}  // namespace ballbar

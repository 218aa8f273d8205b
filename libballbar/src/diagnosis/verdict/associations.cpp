#include "diagnosis/verdict/associations.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "ballbar/error.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/statistics/cross_validation.hpp"
#include "diagnosis/verdict/candidates.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

// The shape of every family that lowers the sum of squares most, the largest fall first. Least squares: a residual of
// which no noise is known is not whitened.
std::vector<std::size_t> by_fall(const SubsetFits& now) {
  const Freed model = freed_of(now.linearised());
  const auto fall = [&](std::size_t index) {
    return (orthonormal(freed(now.columns({index}), model.basis)).transpose() * model.residual).squaredNorm();
  };
  std::vector<std::pair<double, std::size_t>> best;
  for (const Family& family : now.signatures().families) {
    if (family.bound.effect->time_only) continue;
    std::pair<double, std::size_t> most{0.0, family.first};
    for (std::size_t i = family.first; i < family.first + family.count; ++i) most = std::max(most, {fall(i), i});
    best.push_back(most);
  }
  std::stable_sort(best.begin(), best.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::map<const Effect*, std::size_t> taken;
  std::vector<std::size_t> result;
  for (const auto& [value, index] : best) {
    if (result.size() < kAssociationsFitted && ++taken[now.bound(index).effect] <= kAssociationColumns)
      result.push_back(index);
  }
  return result;
}

// Fitted by the noise that is most likely beside it, as long as that makes it more likely.
SubsetFit by_its_own_noise(const SubsetFits& now, std::size_t index, const Noise& noise) {
  SubsetFit with = now.refitted({index}, noise);
  for (std::size_t round = 0; round < kAssociationRounds; ++round) {
    SubsetFit again = now.refitted_from(with, with.set);
    if (!(again.noise_fit.log_likelihood > with.noise_fit.log_likelihood + kWorthAnotherRound)) break;
    with = std::move(again);
  }
  return with;
}

}  // namespace

std::vector<Candidate> associations(const SubsetFits& now, const Noise& noise, const std::vector<std::size_t>& fold) {
  const double before = cross_validation(now.linearised(), noise, fold, false).rmse_um;
  const std::vector<std::size_t> tried = by_fall(now);
  std::vector<std::optional<Candidate>> found(tried.size());
  in_parallel(tried.size(), [&](std::size_t i) {
    try {
      const SubsetFit with = by_its_own_noise(now, tried[i], noise);
      const double after = cross_validation(with.noise_fit.linearised, with.noise_fit.noise, fold, false).rmse_um;
      if (!(after < kAssociation * before)) return;
      found[i] = candidate_of(now, with, 0);
      found[i]->held_out_before_um = before;
      found[i]->held_out_after_um = after;
    } catch (const Error&) {
      return;  // what cannot be fitted explains nothing
    }
  });
  std::vector<Candidate> result;
  for (std::optional<Candidate>& one : found) {
    if (one) result.push_back(std::move(*one));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Candidate& a, const Candidate& b) { return a.held_out_after_um < b.held_out_after_um; });
  if (result.size() > kAssociationsShown) result.erase(result.begin() + kAssociationsShown, result.end());
  return result;
}

}  // namespace ballbar

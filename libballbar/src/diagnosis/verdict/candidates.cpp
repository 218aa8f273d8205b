#include "diagnosis/verdict/candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "diagnosis/search/nested_effects.hpp"
#include "diagnosis/verdict/named_tests.hpp"
#include "fit/linearised_fit.hpp"

namespace ballbar {
namespace {

// Of the grid: all of a series, some of recordings, where each shape needs surrogates on every sweep.
std::vector<std::vector<double>> surrogate_points(const SubsetFits& now, std::size_t index) {
  const Family& family = now.family(index);
  const bool of_recordings = now.model().level == Level::recording;
  if (of_recordings && family.count < 2) return {};
  std::vector<std::vector<double>> points;
  const std::size_t stride = of_recordings ? 1 + (family.count - 1) / kSurrogateShapes : 1;
  for (std::size_t i = family.first; i < family.first + family.count; i += stride) points.push_back(now.at(i).point);
  return points;
}

}  // namespace

double rmse_after_um(const SubsetFits& now, const SubsetFit& with) {
  if (now.model().level == Level::series) return with.noise_fit.fit.rmse_um;
  const Eigen::VectorXd left = freed_of(with.noise_fit.linearised).residual;
  return left.norm() / std::sqrt(static_cast<double>(left.size()));
}

Candidate candidate_of(const SubsetFits& now, const SubsetFit& with, std::size_t place) {
  Candidate candidate = candidate_of(with.model, with.noise_fit.fit, now.model().terms.size() + place);
  candidate.bound = now.bound(with.set[place]);
  candidate.label = label_of(candidate.bound);
  candidate.rmse_after_um = rmse_after_um(now, with);
  return candidate;
}

namespace {

bool is_on_bound(const FittedParameter& parameter) {
  return parameter.state == ParameterState::on_lower_bound || parameter.state == ParameterState::on_upper_bound;
}

}  // namespace

Candidate confirmed(const SubsetFits& now, const Series& data, const SubsetFit& with, std::size_t place,
                    const MaxScoreNull& null, const DiagnosisOptions& options) {
  Candidate candidate = candidate_of(now, with, place);
  const SubsetFit rest = now.without(with, place);
  const WithAndWithout models{data, with.model, now.model().terms.size() + place, with.noise_fit, rest.noise_fit};
  const Effect& effect = *candidate.bound.effect;
  const FoldTests tests = fold_tests(models);
  candidate.in_best_set = true;
  candidate.likelihood_ratio = 2.0 * (with.noise_fit.log_likelihood - rest.noise_fit.log_likelihood);
  candidate.threshold = null.threshold(effect);
  candidate.p_search = null.p_search(effect, candidate.likelihood_ratio);
  candidate.held_out_before_um = tests.before.rmse_um;
  candidate.held_out_after_um = tests.after.rmse_um;
  candidate.p_same_gain = tests.p_same_gain;
  candidate.gain = gain_of(models);
  const auto doubt = [&](std::string why) { candidate.doubts.push_back(std::move(why)); };
  if (effect.time_only) {
    doubt("it needs nothing but time, so that one run cannot name it as a cause");
    return candidate;
  }
  now.tell(fmt::format("testing {} surrogates of {}", options.surrogates, candidate.label));
  const std::optional<BestSurrogate> surrogate = surrogate_of(
      models, candidate.bound, surrogate_points(now, with.set[place]), options.surrogates, options.search.seed);
  candidate = beside_surrogate(std::move(candidate), surrogate);
  const bool of_recordings = now.model().level == Level::recording;
  if (candidate.likelihood_ratio < kLeastLikelihoodRatio) doubt(std::string(kLowLikelihoodRatio));
  if (null.p_search(effect, tests.gain_of_many) >= kErrorOfASearch) doubt("a few readings alone make it");
  if (candidate.p_search >= kErrorOfASearch) doubt("a search without any effect shows as much too often");
  if (candidate.p_same_gain < kSameGain) doubt(gain_differs(of_recordings));
  if (!of_recordings && tests.in_one_fold > kInOneFold) {
    doubt("it shows in one cycle alone, so that no other can confirm it");
  }
  if (!(tests.after.chi2 < tests.before.chi2) || tests.after.rmse_um > kHeldOutWorse * tests.before.rmse_um) {
    doubt(not_predicted_better(of_recordings));
  }
  for (const FittedParameter& parameter : candidate.parameters) {
    if (!is_on_bound(parameter)) continue;
    doubt(fmt::format("its {} lies on its bound, {:g} {}", parameter.name, parameter.value, parameter.unit));
  }
  if (candidate.beats_surrogates && !*candidate.beats_surrogates) doubt(std::string(kSurrogateDoesAsWell));
  return candidate;
}

bool is_at_the_edge(const Candidate& candidate) {
  return !candidate.bound.effect->time_only &&
         std::any_of(candidate.parameters.begin(), candidate.parameters.end(), is_on_bound);
}

namespace {

// The rest of the set is open as well: it does without.
bool is_spare(const SubsetFits& now, const SubsetFit& competitor, std::size_t place, const SubsetFit& best,
              const std::vector<const SubsetFit*>& competitors) {
  const auto is_rest = [&](const SubsetFit& other) { return is_without(now, other.set, competitor.set, place); };
  return is_rest(best) ||
         std::any_of(competitors.begin(), competitors.end(), [&](const SubsetFit* other) { return is_rest(*other); });
}

}  // namespace

std::vector<std::vector<BoundEffect>> groups_of(const SubsetFits& now, const Projected& seen, const SubsetFit& best,
                                                const std::vector<const SubsetFit*>& competitors) {
  std::vector<std::vector<BoundEffect>> groups;
  for (const std::size_t index : best.set) groups.push_back({now.bound(index)});
  for (const SubsetFit* competitor : competitors) {
    for (std::size_t k = 0; k < competitor->set.size(); ++k) {
      const std::size_t extra = competitor->set[k];
      if (has(now, best.set, now.bound(extra))) continue;
      bool same = false;
      for (std::size_t m = 0; m < best.set.size(); ++m) same = same || draws_the_same(now, best, m, *competitor, k);
      if (same || is_spare(now, *competitor, k, best, competitors)) continue;
      // In the place of the one it is most like.
      double most = -1.0;
      std::size_t place = groups.size();
      for (std::size_t m = 0; m < best.set.size(); ++m) {
        if (has(now, competitor->set, now.bound(best.set[m]))) continue;
        const double alike =
            std::abs(seen.columns.col(now.at(best.set[m]).first).dot(seen.columns.col(now.at(extra).first)));
        if (alike > most) {
          most = alike;
          place = m;
        }
      }
      if (place == groups.size()) continue;
      std::vector<BoundEffect>& group = groups[place];
      if (std::find(group.begin(), group.end(), now.bound(extra)) == group.end()) group.push_back(now.bound(extra));
    }
  }
  return groups;
}

}  // namespace ballbar

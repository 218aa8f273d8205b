#include "diagnosis/search/null_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
NullModel null_model_of(const SubsetFits& now, const Noise& start, const SearchOptions& options) {
  Evaluations evaluated = now.evaluated({}, {{}}, start);
  const Noise base_noise = evaluation_of(evaluated, {}).noise;
  double log_likelihood = evaluation_of(evaluated, {}).log_likelihood;
  FirstGuess first = first_guess(now, base_noise, std::move(evaluated));
  const Eigen::MatrixXd columns = now.columns(first.set);
  const Eigen::VectorXd left_um = evaluation_of(first.evaluated, first.set).residual_um;
  const LinearisedFit& linearised = now.linearised();
  const Noise noise = restricted_noise(linearised, columns, left_um);
  if (now.has_few_rows()) {
    first.evaluated = now.evaluated({}, {{}}, noise);
    log_likelihood = evaluation_of(first.evaluated, {}).log_likelihood;
  }
  Projected seen = now.projected_by(noise);
  now.tell(fmt::format("searching {} data sets without any effect", options.draws));
  MaxScoreNull null = max_score_null(now.signatures(), seen, linearised, noise,
                                     plausible_noises(linearised, columns, noise, kPlausibleNoises, options.seed),
                                     options.draws, options.seed);
  const bool heavy = has_heavy_tails(whitened(Whitening(noise, linearised.time_s, linearised.sigma_um), left_um));
  return {std::move(first.set), std::move(first.evaluated), noise, base_noise, log_likelihood, heavy, std::move(seen),
          std::move(null)};
}

Detected detected(const SubsetFits& now, const NullModel& null_model) {
  const Projected& seen = null_model.seen;
  const Eigen::VectorXd score =
      scores(now.signatures(), seen, null_model.heavy_tails ? clipped(seen.residual) : seen.residual);
  Detected result;
  result.smallest_um = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < now.signatures().signatures.size(); ++i) {
    const Effect& effect = *now.bound(i).effect;
    result.p_anything =
        std::min(result.p_anything, null_model.null.p_search(effect, score[static_cast<Eigen::Index>(i)]));
    const double um = detectable_um(now.signatures(), seen, i, std::sqrt(null_model.null.threshold(effect)));
    if (um >= result.smallest_um) continue;
    result.smallest_um = um;
    result.smallest = now.bound(i);
  }
  return result;
}

}  // namespace ballbar

#include "diagnosis/posterior/search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ballbar/internal/numerics/parallel.hpp"
#include "diagnosis/evidence/shape_fit.hpp"
#include "diagnosis/posterior/conditional_fit.hpp"
#include "diagnosis/posterior/hyperparameters.hpp"
#include "diagnosis/posterior/sets.hpp"

namespace ballbar {
namespace {

// The values that a fit finds for the held parameters, one by one.
std::vector<double> fitted_values_of(const Problem& problem, const Linearisation& linearisation,
                                     const Covariance& covariance) {
  const NoiseFilter filter = noise_filter_at(problem, covariance);
  std::vector<double> values;
  values.reserve(problem.held.size());
  for (const HeldParameter& one : problem.held) {
    values.push_back(shape_fit(*problem.base_model, linearisation.parameters, {one.parameter}, linearisation.open,
                               filter.whitening, problem.known, kSearched)
                         .parameters[one.parameter]);
  }
  return values;
}

// The effects that a single effect may be, the strongest first.
std::vector<std::size_t> effects_of(const Problem& problem, const SingleEffect& one) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < problem.effects; ++i) {
    if (one.log_weight[i] > kLogZero) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return one.log_weight[a] > one.log_weight[b]; });
  if (order.empty()) return order;
  const double strongest = one.log_weight[order.front()];
  const double far = strongest - problem.tuning.far_rival - problem.tuning.of_grid * std::max(0.0, strongest);
  while (order.size() > 1 && one.log_weight[order.back()] < far) order.pop_back();
  return order;
}

// The held value that is more likely wrong than right.
std::optional<std::size_t> likeliest_held(const SearchResult& found) {
  for (const std::size_t i : likeliest_set(found.sum)) {
    if (found.identities.is_held_value(i)) return i - found.identities.families;
  }
  return std::nullopt;
}

// The parameters with all free times of the model at this one.
std::vector<double> with_times(const Problem& problem, std::vector<double> parameters, double time_s) {
  for (std::size_t k = 1; k < problem.base_model->parameters(); ++k) {
    const Setting& setting = problem.base_model->setting(k);
    const Parameter& parameter = problem.base_model->parameter(k);
    if (parameter.kind == ParameterKind::shape && parameter.unit == "s" && !setting.held)
      parameters[k] = std::clamp(time_s, setting.lower, setting.upper);
  }
  return parameters;
}

// The shapes of the likeliest effect of each single effect that is likely to be there, and of its strongest rivals.
struct SetWithRivals {
  std::vector<std::size_t> set;                  // signatures
  std::vector<std::vector<std::size_t>> rivals;  // of each
};
SetWithRivals set_with_rivals(Problem& problem, const SearchResult& found) {
  SetWithRivals result;
  for (const SingleEffect& one : found.sum.effects) {
    if (one.p_any() < 0.5 || found.identities.is_held_value(likeliest_identity(one))) continue;
    const std::vector<std::size_t> order = effects_of(problem, one);
    std::vector<std::size_t> shapes;
    for (std::size_t k = 0; k < std::min(order.size(), problem.tuning.sharpened); ++k) {
      if (const auto shape = signature_of(problem, found.identities, one.likeliest[order[k]])) shapes.push_back(*shape);
    }
    if (shapes.empty()) continue;
    result.set.push_back(shapes.front());
    result.rivals.emplace_back(shapes.begin() + 1, shapes.end());
  }
  return result;
}

// Whether one of these signatures is of the same effect on the same columns.
bool has_family_of(const Problem& problem, const std::vector<std::size_t>& signatures, std::size_t signature) {
  const auto family = [&](std::size_t i) { return problem.library.signatures[i].family; };
  return std::any_of(signatures.begin(), signatures.end(),
                     [&](std::size_t i) { return family(i) == family(signature); });
}

// The model beside the effects of the sum, with the delays of the inputs of both. The most likely shapes of the
// effects, and of their rivals, become signatures, and found.fitted has those of the effects.
Linearisation sharpened_model(Problem& problem, SearchResult& found) {
  const NoiseFilter filter = noise_filter_at(problem, found.covariances.front());
  const auto [set, rivals] = set_with_rivals(problem, found);
  // Beside a held value that is another one, at that one.
  Linearisation about = found.linearisation;
  const std::optional<std::size_t> held = likeliest_held(found);
  if (held) {
    std::vector<double> parameters = about.parameters;
    parameters[problem.held[*held].parameter] = found.fitted_values[*held];
    about = linearisation_at(problem, *held, std::move(parameters));
  }
  // Without the effects the fit may have driven a time constant to its bound, from where no step leads back.
  std::vector<std::vector<double>> starts{about.parameters};
  if (std::isfinite(problem.tuning.usual_time_s)) {
    std::vector<double> usual = with_times(problem, about.parameters, problem.tuning.usual_time_s);
    if (usual != about.parameters) starts.push_back(std::move(usual));
  }
  ConditionalFit best = sharpened(problem, about, set, starts, filter);
  found.fitted = best.signatures;
  const LinearModel model = linearisation_at(problem, held, best.parameters, about.open).linear;
  for (std::size_t m = 0; m < rivals.size(); ++m) {
    std::vector<std::size_t> others = best.signatures;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(m));
    std::vector<std::size_t> alone = rivals[m];
    std::erase_if(alone, [&](std::size_t rival) { return has_family_of(problem, others, rival); });
    if (!alone.empty()) sharpen_beside(problem, with_signatures(problem, model, others), alone, filter);
  }
  Eigen::MatrixXd open = with_levels(problem, std::move(best.delays));
  if (!held) return linearisation_at(problem, std::nullopt, std::move(best.parameters), std::move(open));
  // The gains beside the held value: what is open of times is in units of the gains.
  const HeldParameter& parameter = problem.held[*held];
  found.fitted_values[*held] = best.parameters[parameter.parameter];
  best.parameters[parameter.parameter] = parameter.value;
  ShapeFit fit =
      shape_fit(*problem.base_model, std::move(best.parameters), {}, open, filter.whitening, problem.known, {0});
  return linearisation_at(problem, std::nullopt, std::move(fit.parameters), std::move(open));
}

// The best shape of each effect of the catalogue as the only one, on the columns where it is likeliest. Between the
// shapes of the grid a few others would imitate an effect that explains all alone.
void sharpen_alone(Problem& problem, const SearchResult& found) {
  const auto plain = std::find_if(found.covariances.begin(), found.covariances.end(),
                                  [](const Covariance& one) { return !(one.slow > 0.0); });
  if (plain == found.covariances.end()) return;
  const LinearModel& linear = found.linearisation.linear;
  const SumOfEffects sum =
      sum_at(problem, found.identities, linear, *plain, ibss_options(problem, found.identities, 1, Forms::no));
  const SingleEffect& one = sum.effects.front();
  std::vector<const Effect*> seen;
  std::vector<std::size_t> signatures;
  for (const std::size_t i : effects_of(problem, one)) {
    const Effect* effect = problem.library.families[i].bound.effect;
    if (std::find(seen.begin(), seen.end(), effect) != seen.end()) continue;
    seen.push_back(effect);
    if (const auto shape = signature_of(problem, found.identities, one.likeliest[i])) signatures.push_back(*shape);
  }
  sharpen_beside(problem, linear, signatures, noise_filter_at(problem, *plain));
}

// The model, and the identities about it, beside the effects of the sum.
void fit_model(Problem& problem, SearchResult& found) {
  found.linearisation = sharpened_model(problem, found);
  found.identities = identities_of(problem, found.linearisation, found.fitted_values);
}

// The shape of an identity that has this signature; for a jump the row at its moment.
std::size_t shape_of(const Problem& problem, const Identities& identities, std::size_t identity,
                     std::size_t signature) {
  const std::size_t first = identities.first[identity], end = first + identities.count[identity];
  for (std::size_t s = first; s < end; ++s) {
    const auto row = static_cast<std::size_t>(identities.shapes[s].first - identities.columns.cols());
    if (identities.jump == identity ? problem.time_s[row] > problem.library.signatures[signature].point[1]
                                    : identities.shapes[s].signature == signature)
      return s;
  }
  return kNoSignature;
}

// With one single effect for each of these identities, at the shapes that the fit of the model has.
IbssOptions with_fitted(const Problem& problem, const SearchResult& of, const Identities& identities,
                        const IbssOptions& options, const std::vector<std::size_t>& set) {
  IbssOptions exact = with_exactly(options, set);
  auto fitted = of.fitted.begin();
  for (std::size_t l = 0; l < set.size(); ++l) {
    const auto own = std::find_if(fitted, of.fitted.end(), [&](std::size_t signature) {
      return problem.library.signatures[signature].family == set[l];
    });
    if (own == of.fitted.end()) continue;
    exact.priors[l].shape = shape_of(problem, identities, set[l], *own);
    fitted = own + 1;
  }
  return exact;
}

// The sum at a covariance, first with exactly these identities.
SumOfEffects sum_from(const Problem& problem, const SearchResult& of, const Covariance& covariance, std::size_t largest,
                      const std::vector<std::size_t>& set) {
  const NoiseFilter filter = noise_filter_at(problem, covariance);
  ProjectedColumns at(problem, of.identities, of.linearisation.linear, filter);
  const IbssOptions options = ibss_options(problem, of.identities, largest, Forms::no);
  if (set.empty()) return ibss(at, of.identities, options);
  return ibss(at, of.identities, options,
              ibss(at, of.identities, with_fitted(problem, of, of.identities, options, set)));
}

// The sum at the first covariance with this identity in no single effect: coordinate ascent finds one mode, and another
// one may be likelier (Zou et al. 2022, PLoS Genet. 18, e1010299, `refine`).
SumOfEffects sum_without(const Problem& problem, const SearchResult& of, std::size_t largest, std::size_t identity) {
  IbssOptions options = ibss_options(problem, of.identities, largest, Forms::no);
  options.priors.front().log_identity[identity] = kLogZero;
  return sum_at(problem, of.identities, of.linearisation.linear, of.covariances.front(), options);
}

// The most likely covariance of this kind beside exactly these identities.
Covariance covariance_beside_set(const Problem& problem, const SearchResult& of, const Covariance& start,
                                 const std::vector<std::size_t>& set) {
  const Identities members = restricted(of.identities, set);
  const LinearModel& linear = of.linearisation.linear;
  const IbssOptions options =
      with_fitted(problem, of, members, ibss_options(problem, members, set.size(), Forms::no), set);
  return covariance_beside(problem, sum_at(problem, members, linear, start, options), members, linear, start);
}

// The covariance of this kind beside the sum from nothing, and the sum there.
void settle(const Problem& problem, const SearchResult& of, std::size_t largest, Covariance& covariance,
            SumOfEffects& sum) {
  sum = sum_from(problem, of, covariance, largest, {});
  covariance = covariance_beside(problem, sum, of.identities, of.linearisation.linear, covariance);
  sum = sum_from(problem, of, covariance, largest, likeliest_set(sum));
}

// The same from the effects of the sum, at the shapes that the fit has.
void settle_again(const Problem& problem, std::size_t largest, SearchResult& found) {
  Covariance& covariance = found.covariances.front();
  const std::vector<std::size_t> set = likeliest_set(found.sum);
  if (set.empty()) return settle(problem, found, largest, covariance, found.sum);
  covariance = covariance_beside_set(problem, found, covariance, set);
  found.sum = sum_from(problem, found, covariance, largest, set);
}

double log_weight_of(const SearchResult& of) { return of.sum.elbo + of.covariances.front().log_prior; }

// Settles the covariance of each kind of discrepancy. The most likely kind becomes the first, and its sum is kept.
void settle_all(const Problem& problem, std::size_t largest, SearchResult& of) {
  std::vector<SumOfEffects> sums(of.covariances.size());
  in_parallel(sums.size(), [&](std::size_t k) { settle(problem, of, largest, of.covariances[k], sums[k]); });
  std::size_t best = 0;
  const auto log_weight = [&](std::size_t k) { return sums[k].elbo + of.covariances[k].log_prior; };
  for (std::size_t k = 1; k < sums.size(); ++k) best = log_weight(k) > log_weight(best) ? k : best;
  std::swap(of.covariances.front(), of.covariances[best]);
  of.sum = std::move(sums[best]);
}

bool is_same_mode(const Problem& problem, const SearchResult& a, const SearchResult& b) {
  return std::abs(log_weight_of(a) - log_weight_of(b)) < problem.tuning.better &&
         sorted_set(a.sum) == sorted_set(b.sum);
}

// Whether a mode that rose by so much in a round is too far behind the other to reach it in the next.
bool is_far_behind(const Problem& problem, const SearchResult& mode, double rise, const SearchResult& other) {
  return log_weight_of(mode) + std::max(problem.tuning.far_mode, rise) < log_weight_of(other);
}

// The model and the shapes about where the sum has them, and the sum there, until its weight stays, or the mode is the
// other one, or far less likely. The last round is kept even where its weight is lower: about parameters that no fit
// has, the linear model promises what the model cannot do.
void converge(Problem& problem, std::size_t largest, SearchResult& found, const SearchResult* other = nullptr) {
  for (int round = 0; round < problem.tuning.most_refined; ++round) {
    const double before = log_weight_of(found);
    fit_model(problem, found);
    settle_again(problem, largest, found);
    const double rise = log_weight_of(found) - before;
    if (std::abs(rise) < problem.tuning.better) break;
    if (other != nullptr && (is_same_mode(problem, found, *other) || is_far_behind(problem, found, rise, *other)))
      break;
  }
}

bool has_free_shapes(const Problem& problem) {
  for (std::size_t k = 1; k < problem.base_model->parameters(); ++k) {
    if (problem.base_model->parameter(k).kind == ParameterKind::shape && !problem.base_model->setting(k).held)
      return true;
  }
  return false;
}

// The model beside all effects of the sum but one: an effect may stand for a term of the model that was fitted beside
// it.
void fit_without(Problem& problem, std::size_t identity, SearchResult& found) {
  std::erase_if(found.sum.effects, [&](const SingleEffect& one) { return likeliest_identity(one) == identity; });
  fit_model(problem, found);
}

// One mode for each set of identities, the likeliest first.
void add_mode(const Problem& problem, SearchResult mode, std::vector<SearchResult>& modes) {
  const auto same = std::find_if(modes.begin(), modes.end(),
                                 [&](const SearchResult& one) { return sorted_set(one.sum) == sorted_set(mode.sum); });
  const bool is_first = log_weight_of(mode) > log_weight_of(modes.front()) + problem.tuning.better;
  if (same == modes.end()) {
    modes.insert(is_first ? modes.begin() : modes.end(), std::move(mode));
  } else if (log_weight_of(mode) > log_weight_of(*same) + problem.tuning.better) {
    *same = std::move(mode);
    if (is_first) std::rotate(modes.begin(), same, same + 1);
  }
}

}  // namespace

SearchResult mode_of(Problem& problem, std::size_t largest) {
  const std::vector<double> fit = fitted_parameters(problem);
  SearchResult found;
  found.linearisation = linearisation_at(problem, std::nullopt, fit);
  found.covariances = likeliest_covariances(problem, with_any_forms(problem, found.linearisation.linear));
  found.fitted_values = fitted_values_of(problem, found.linearisation, found.covariances.front());
  found.identities = identities_of(problem, found.linearisation, found.fitted_values);
  sharpen_alone(problem, found);
  found.identities = identities_of(problem, found.linearisation, found.fitted_values);
  settle_all(problem, largest, found);
  converge(problem, largest, found);
  return found;
}

std::vector<SearchResult> likely_modes(Problem& problem, std::size_t largest, SearchResult first) {
  std::vector<SearchResult> modes;
  modes.push_back(std::move(first));
  if (!problem.tuning.refine) return modes;
  const std::vector<SingleEffect> effects = modes.front().sum.effects;
  for (const SingleEffect& one : effects) {
    const SearchResult& found = modes.front();
    const std::size_t without = likeliest_identity(one);
    if (one.p_any() < 0.5 || found.identities.is_held_value(without)) continue;
    SearchResult other = found;
    if (has_free_shapes(problem)) fit_without(problem, without, other);
    SumOfEffects sum = sum_without(problem, other, largest, without);  // at the same covariance
    const double far = problem.tuning.far_mode + problem.tuning.of_grid * std::max(0.0, one.log_odds);
    if (sum.elbo < found.sum.elbo - far) continue;
    other.sum = std::move(sum);
    converge(problem, largest, other, &found);
    add_mode(problem, std::move(other), modes);
  }
  if (!problem.tuning.modes) modes.resize(1);
  const double far = log_weight_of(modes.front()) - problem.tuning.far_from_best;
  std::erase_if(modes, [&](const SearchResult& one) { return log_weight_of(one) < far; });
  return modes;
}

}  // namespace ballbar

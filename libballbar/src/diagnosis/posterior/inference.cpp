#include "diagnosis/posterior/inference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "diagnosis/posterior/identities.hpp"
#include "diagnosis/posterior/robust.hpp"
#include "diagnosis/posterior/sets.hpp"

namespace ballbar {
namespace {

// Of a long series every k-th value is used: where the mode has jumps, all values about them. Empty: it has none, or
// all values are used already.
std::vector<double> jumps_to_look_at_s(Problem& problem, const SearchResult& mode, std::size_t most_rows,
                                       const std::vector<double>& values) {
  const auto known = std::count_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); });
  if (!problem.tuning.whole_about_jumps || static_cast<std::size_t>(known) <= most_rows) return {};
  std::vector<double> moments_s;
  for (const SingleEffect& one : mode.sum.effects) {
    const std::size_t identity = likeliest_identity(one);
    if (one.p_any() < 0.5 || mode.identities.jump != identity) continue;
    if (const auto jump = signature_of(problem, mode.identities, one.likeliest[identity]))
      moments_s.push_back(problem.library.signatures[*jump].point[1]);
  }
  return moments_s;
}

std::vector<ProbableSoFar> probable_so_far(const Problem& problem, const std::vector<double>& p) {
  std::vector<ProbableSoFar> effects;
  for (std::size_t f = 0; f < problem.effects; ++f) effects.push_back({problem.library.families[f].bound, p[f]});
  std::stable_sort(effects.begin(), effects.end(),
                   [](const ProbableSoFar& left, const ProbableSoFar& right) { return left.p > right.p; });
  return effects;
}

}  // namespace

Inference inference(const Model& model, const Series& data, std::size_t target, const ProblemOptions& options) {
  Inference result;
  result.problem = problem_of(model, data, target, options);
  const Problem& first = *result.problem;
  result.largest = largest_sum(first);
  result.is_still = is_still(first);
  if (result.largest == 0 || result.is_still) return result;
  std::set<const Effect*> effects;
  for (std::size_t f = 0; f < first.effects; ++f) effects.insert(first.library.families[f].bound.effect);
  const auto tell = [&](std::string_view step) {
    if (options.search.progress) options.search.progress(step);
  };
  const auto tell_so_far = [&](const std::vector<double>& p) {
    if (options.search.so_far) options.search.so_far(probable_so_far(*result.problem, p));
  };
  const auto mode = [&] {
    SearchResult found = mode_of(*result.problem, result.largest);
    tell_so_far(inclusion_probabilities(found.sum, result.problem->effects));
    return found;
  };
  const auto infer_from = [&](SearchResult found) {
    result.posterior =
        posterior_of(*result.problem, result.largest, likely_modes(*result.problem, result.largest, std::move(found)));
    tell_so_far(result.posterior.family);
  };
  tell(fmt::format("weighing {} shapes of {} effects", first.library.signatures.size(), effects.size()));
  note_outliers(*result.problem);
  SearchResult found = mode();
  const std::vector<double> jumps_s =
      jumps_to_look_at_s(*result.problem, found, options.most_rows, find_column(data, model.targets[target])->values);
  if (!jumps_s.empty()) {
    tell("weighing again, every value about a jump");
    ProblemOptions again = options;
    again.whole_about_s.insert(again.whole_about_s.end(), jumps_s.begin(), jumps_s.end());
    again.logged = nullptr;  // of other rows
    result.problem = problem_of(model, data, target, again);
    note_outliers(*result.problem);
    found = mode();
  }
  infer_from(std::move(found));
  // On recordings no input of any form stands for the missing effects before they are found.
  Problem& problem = *result.problem;
  const EffectSet& best = result.posterior.sets[result.posterior.best];
  if (model.level != Level::recording ||
      !weigh_down_outliers(
          problem,
          with_signatures(problem, result.posterior.linearisations[best.linearisation].linear, best.signatures),
          result.posterior.filters[best.filter]))
    return result;
  tell("weighing again, outliers less");
  infer_from(mode());
  return result;
}

std::optional<std::size_t> family_of(const Problem& problem, const BoundEffect& bound) {
  for (std::size_t f = 0; f < problem.effects; ++f) {
    const BoundEffect& one = problem.library.families[f].bound;
    if (one.effect->name == bound.effect->name && one.columns == bound.columns) return f;
  }
  return std::nullopt;
}

}  // namespace ballbar

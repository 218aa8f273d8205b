// Which physical effect a model lacks - or that the data cannot tell.
//
// A falling error proves fit, not cause: on records with a memory a random smooth signal also lowers it. So an effect
// is named only where
//   the search as a whole shows scores as large in less than 1 % of data sets without any effect (2000 draws of the
//   noise, each from a noise that the data do not exclude),
//   no competing set of up to three effects that explains the data nearly as well (2 ln L less thresholds within 6 of
//   the best, 12 where that has three effects) has another in its place,
//   its 2 ln LR is at least 25 (d >= 5) and not made by a few readings or one cycle alone, the same gain holds in every
//   cycle, cycles left out are predicted better, no parameter lies on its bound, it beats the best of 200 surrogates of
//   its own smoothness, it is driven by a logged input,
//   and what the best set leaves is noise and no smooth curve.
// 2 ln LR: 2 ln of the likelihood ratio, the noise estimated anew under each hypothesis. Sets of effects are searched
// together, not one after the other.
//
// On recordings a cycle is a recording, of one alone a quarter of its sweep; surrogates are curves over the angle, and
// an effect of one or two waves a turn has none: it is not tested against surrogates.
//
// Of more than 1500 values of the target every second, third ... is searched; figures of the effects are of that
// search. O(n) in rows, linear in signatures; 20 effects take about 1.3 s of processor time at 1500 rows, 4 s at 5000.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/search/search_options.hpp"
#include "ballbar/diagnosis/signatures/identifiability.hpp"
#include "ballbar/diagnosis/verdict/candidate.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/fit/residual.hpp"
#include "ballbar/model/bound_effect.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

enum class Verdict { named, equivalent, unexplained, untestable, nothing };
std::string_view name_of(Verdict verdict);

struct Diagnosis {
  std::string target;
  Fit base;
  Verdict verdict = Verdict::nothing;
  std::vector<BoundEffect> named;
  std::vector<std::vector<BoundEffect>> equivalent;  // each: effects of which one is it
  std::vector<Candidate> candidates;                 // the best set first, then its competitors; at most 12
  // Unexplained: what it goes with, each alone beside the model; the lowest held-out RMSE first, at most 4.
  std::vector<Candidate> associations;
  double p_anything = 1.0;               // share of data sets without any effect with a best score as rare
  double smooth_likelihood_ratio = 0.0;  // 2 ln L gained by the most likely smooth curve
  double best_surrogate_fall = 0.0;      // relative fall of the RMSE by the best of the surrogates
  double smallest_um = 0.0;              // amplitude that would have been found, of the effect that shows best
  BoundEffect smallest;                  // that effect
  double rmse_after_um = 0.0;            // with the best set
  std::size_t searched_effects = 0;
  std::vector<Detectability> detectability;  // what the data could show, as preflight
  std::vector<std::string> reasons;          // why not `named`; whole sentences
};

struct DiagnosisOptions {
  SearchOptions search;
  double tolerance_um = 0.0;  // smaller effects are called minor
  std::size_t surrogates = kSurrogates;
  std::size_t most_rows = 1500;  // values of the target searched
};

// Throws Error as fit does.
Diagnosis diagnose(const Model& model, const Series& data, std::size_t target = 0,
                   const DiagnosisOptions& options = {});

}  // namespace ballbar

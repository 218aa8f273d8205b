// The posterior of the missing part: a mixture of sums of single effects (ibss.hpp), one for each likely covariance of
// each likely mode.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "diagnosis/posterior/identities.hpp"
#include "diagnosis/posterior/linearisation.hpp"
#include "diagnosis/posterior/problem.hpp"
#include "diagnosis/posterior/search.hpp"

namespace ballbar {

// One of the single effects: at most one of its identities is missing.
struct SinglePosterior {
  std::vector<double> alpha;  // per identity: families of the library, then held values
  double p_any() const;
};

// A mode of the posterior, averaged over its covariances.
struct PosteriorMode {
  double p = 1.0;
  std::vector<SinglePosterior> effects;
};

// A set of effects: one identity for some of the single effects, added to the model, or to the model with one held
// parameter free.
struct EffectSet {
  std::vector<std::size_t> families;  // rising
  std::optional<std::size_t> freed;   // as Linearisation::freed
  double log_weight = 0.0;            // ln of its probability
  // Where it is likeliest:
  std::vector<std::size_t> signatures;
  std::size_t filter = 0, linearisation = 0;
  std::vector<std::size_t> single;  // per family its single effect in the likeliest mode; empty: of no effect of it
};

struct Posterior {
  std::vector<NoiseFilter> filters;  // of the sums, the most likely first
  std::vector<Covariance> kinds;     // the likeliest covariance of each kind of discrepancy, as the search found it
  std::vector<Linearisation>
      linearisations;     // the model at its most likely parameters, of each mode, then with one held parameter free
  Identities identities;  // at the first linearisation; shapes that a later fit adds to the library change no evidence
  std::vector<PosteriorMode> modes;  // the likeliest first
  std::vector<double> family, held;  // posterior inclusion probability of each family and each held value
  double nothing = 1.0;              // P of no effect, wrong held value and discrepancy
  double none = 1.0;                 // P of no effect and no wrong held value
  double discrepancy = 0.0;          // P of a slow discrepancy
  std::vector<EffectSet> sets;       // the most probable first; the empty set is among them
  std::size_t best = 0;              // index of the set of the likeliest identities of the likely single effects
  double log_total = 0.0;            // of the sets
  mutable std::map<std::vector<std::size_t>, double> log_evidence;  // of requested sets (log_bayes_factor)

  double p(const EffectSet& set) const;
};

// Of the modes that a search has found. The weight of a sum is exp(lower bound): the best mixture of distributions that
// do not overlap (Jaakkola and Jordan 1998, Improving the mean field approximation via the use of mixture
// distributions). largest: largest number of effects.
Posterior posterior_of(Problem& problem, std::size_t largest, std::vector<SearchResult> modes);

// The index of a requested set of effects; appends it if it is new.
std::size_t set_of(Problem& problem, Posterior& posterior, std::vector<std::size_t> families);

// 2 ln of the Bayes factor of the model with this set against the model alone; gains, shapes and noise are integrated
// out. -infinity: the model absorbs the set.
double log_bayes_factor(const Problem& problem, const Posterior& posterior, const std::vector<std::size_t>& families);

}  // namespace ballbar

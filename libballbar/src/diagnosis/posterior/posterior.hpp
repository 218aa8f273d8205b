// The posterior of the missing part as a sum of single effects (ascent.hpp), averaged over the likely covariances.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <vector>

#include "diagnosis/posterior/identities.hpp"
#include "diagnosis/posterior/problem.hpp"
#include "diagnosis/posterior/variant.hpp"

namespace ballbar {

// One of the single effects: at most one of its identities is missing.
inline constexpr double kPriorOfNone = 0.8;  // prior that a single effect is nothing

struct SinglePosterior {
  std::vector<double> p;  // per identity: families of the library, then held values
  double p_any() const;
};

// A set of effects: one identity for some of the single effects, added to the model, or to the model with one held
// parameter free.
struct EffectSet {
  std::vector<std::size_t> families;  // rising
  std::size_t own = 0;                // as Variant::own
  double log_weight = 0.0;            // ln of its probability
  double log_weight_slow = 0.0;       // with a slow discrepancy beside it
  // Where it is likeliest:
  std::vector<std::size_t> signatures;
  std::size_t point = 0, variant = 0;
  std::vector<std::size_t> single;  // per family the index of its single effect; empty for a requested set
};

struct Posterior {
  std::vector<Point> points;      // covariances, the most likely first
  std::vector<double> weight;     // of each
  std::vector<Covariance> kinds;  // the likeliest covariance of each kind of discrepancy, as the search found it
  std::vector<Variant> variants;  // the model at its most likely parameters, then with one held parameter free
  Identities identities;  // at the first variant; shapes that a later fit adds to the library change no evidence
  std::vector<SinglePosterior> effects;
  std::vector<double> family, own;  // P of each family and each held value
  double nothing = 1.0;             // P of no effect, wrong held value and discrepancy
  double none = 1.0;                // P of no effect and no wrong held value
  double discrepancy = 0.0;         // P of a slow discrepancy
  std::vector<EffectSet> sets;  // the most probable first; that of the likeliest identity of each single effect that is
                                // likely to be there is `best`; the first of no effects is always there
  std::size_t best = 0;
  double log_total = 0.0;                                           // of the sets
  mutable std::map<std::vector<std::size_t>, double> log_evidence;  // of requested sets (log_bayes_factor)

  double p(const EffectSet& set) const;
};

// largest: largest number of effects. so_far: called with P of each identity as the search proceeds; may be empty.
// Shapes of likely effects between the points of the grid are added to the library.
Posterior posterior_of(Problem& problem, std::size_t largest,
                       const std::function<void(const std::vector<double>&)>& so_far = {});

// The index of a requested set of effects; appends it if it is new.
std::size_t set_of(Problem& problem, Posterior& posterior, std::vector<std::size_t> families);

// 2 ln of the Bayes factor of the model with this set against the model alone; gains, shapes and noise are integrated
// out. -infinity: the model absorbs the set.
double log_bayes_factor(const Problem& problem, const Posterior& posterior, const std::vector<std::size_t>& families);

}  // namespace ballbar

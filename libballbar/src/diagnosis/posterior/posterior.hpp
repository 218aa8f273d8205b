// What may be missing, as a sum of single effects (ascent.hpp), averaged over the covariances at which the readings are
// likely.
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
inline constexpr double kPriorOfNone = 0.8;          // that a single effect is nothing
inline constexpr double kPriorOfDiscrepancy = 0.15;  // that there is a slow one

struct SinglePosterior {
  std::vector<double> p;  // of each identity: families of the library, then held values
  double p_any() const;
};

// One identity for some of the single effects: a set of effects beside the model, or beside it with one of its held
// parameters free.
struct EffectSet {
  std::vector<std::size_t> families;  // rising
  std::size_t own = 0;                // as Variant::own
  double log_weight = 0.0;            // ln of its probability
  double log_weight_slow = 0.0;       // with a slow discrepancy beside it
  // Where it is likeliest:
  std::vector<std::size_t> signatures;
  std::size_t point = 0, variant = 0;
  std::vector<std::size_t> single;  // of each family the single effect that it is; empty of a set that was asked for
};

struct Posterior {
  std::vector<Point> points;      // covariances, the likeliest first
  std::vector<double> weight;     // of each
  std::vector<Variant> variants;  // the model about its likeliest parameters; behind it with a held one free
  std::vector<SinglePosterior> effects;
  std::vector<double> family, own;  // P of each family and each held value
  double nothing = 1.0;             // P of no effect, no other value, no discrepancy, no background
  double none = 1.0;                // P of no effect and no other value, whatever else
  double discrepancy = 0.0;         // P of a slow discrepancy
  std::vector<double> background;   // P of a little of every input, by the family of any form that it mostly is
  std::vector<EffectSet> sets;  // the most probable first; that of the likeliest identity of each single effect that is
                                // likely to be there is `best`; the first of no effects is always there
  std::size_t best = 0;
  double log_total = 0.0;                                           // of the sets
  mutable std::map<std::vector<std::size_t>, double> log_evidence;  // of sets that were asked for (log_bayes_factor)

  double p(const EffectSet& set) const;
};

// largest: number of effects. so_far: told of P of each identity whenever more is known; may be empty. Shapes of likely
// effects between the points of the grid are added to the library.
Posterior posterior_of(Problem& problem, std::size_t largest,
                       const std::function<void(const std::vector<double>&)>& so_far = {});

// A set of effects that is asked for, put behind the others where it is not one of them; its place.
std::size_t set_of(Problem& problem, Posterior& posterior, std::vector<std::size_t> families);

// 2 ln of how much more likely the readings are with this set beside the model than without: gains, shapes and noise
// integrated out. -infinity: nothing is left of it beside the model.
double log_bayes_factor(const Problem& problem, const Posterior& posterior, const std::vector<std::size_t>& families);

}  // namespace ballbar

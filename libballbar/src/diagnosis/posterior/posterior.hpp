// The posterior over sets of effects: what of the table counts, summed over the covariances.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/problem.hpp"
#include "diagnosis/posterior/table.hpp"
#include "diagnosis/posterior/variant.hpp"

namespace ballbar {

// Effects of the library, beside the model as it is or with one of its own held parameters free.
struct EffectSet {
  std::vector<std::size_t> families;  // rising
  std::size_t own = 0;                // as Variant::own
  double log_weight = 0.0;            // ln of prior times evidence
  double log_weight_slow = 0.0;       // the part of it with a discrepancy
  // Where it is largest:
  std::vector<std::size_t> signatures;
  std::size_t point = 0, variant = 0;
  double most = 0.0;
};

struct Posterior {
  std::vector<Point> points;        // the likely covariances
  std::vector<Variant> variants;    // the model about the parameters that sets of effects make most likely
  std::vector<EffectSet> sets;      // the most probable first; the first of no effects is always there
  double log_total = 0.0;           // of the sets
  std::vector<EffectSet> any_form;  // one input of any form, alone: rivals, no part of the total

  double p(const EffectSet& set) const;
};

// Without sets in which an effect on a signal of another one has not that one's gain, or is no more than what a logger
// leaves open.
Posterior summed(const Problem& problem, SetTable table);

}  // namespace ballbar

// A sum of single effects at one covariance, by coordinate ascent on the evidence lower bound (Wang, Sarkar, Carbonetto
// and Stephens 2020, J. R. Stat. Soc. B 82, 1273).
//
// Each single effect is nothing, or one identity with one of its shapes and its gains. One after the other is fitted to
// what the others leave, until the bound rises no more; then one more is added, until the next carries less than half a
// unit of probability.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "diagnosis/posterior/columns_at.hpp"

namespace ballbar {

// Of one single effect.
struct SinglePrior {
  double log_none = 0.0;
  std::vector<double> log_identity;
};

struct SingleEffect {
  double log_weight = kLogZero;                       // ln of the weight of any identity over that of none
  std::vector<double> p;                              // of each identity; the rest is nothing
  std::vector<std::size_t> likeliest;                 // the shape of each identity, of Identities::shapes
  std::vector<double> strength;                       // ln of the weight of that shape, where P is too small to tell
  std::vector<std::pair<Eigen::Index, double>> mean;  // coefficients of columns
  ColumnsAt::Curve curve;                             // of the mean
  double spread = 0.0;                                // expected square of what it adds, in units of the scatter
  double divergence = 0.0;                            // of its posterior from its prior
  double p_any() const;
  double p_none() const;  // exact where it is far below 1
};

struct Ascent {
  std::vector<SingleEffect>
      effects;            // the last is the next, which carries less than half, or the largest number's last
  double bound = 0.0;     // of ln of the evidence
  double variance = 0.0;  // of the scatter
};

struct AscentOptions {
  std::vector<SinglePrior> priors;     // of each single effect; the last holds for all behind it
  std::size_t least = 0, largest = 0;  // number of single effects
  KnownScatter known;
  double least_variance = 0.0;  // of the scatter: below it is rounding
};

// start: where it begins; settles the columns about the scatter that is found.
Ascent ascended(ColumnsAt& at, const Identities& identities, const AscentOptions& options, Ascent start = {});

// Out of a poor local optimum: each single effect is put in the place of each of its strongest rivals by turns, and the
// best bound is kept.
Ascent rearranged(const ColumnsAt& at, const Identities& identities, const AscentOptions& options, Ascent best);

}  // namespace ballbar

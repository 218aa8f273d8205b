// A sum of single effects at one covariance, by coordinate ascent on the evidence lower bound (Wang, Sarkar, Carbonetto
// and Stephens 2020, J. R. Stat. Soc. B 82, 1273).
//
// Each single effect is nothing, or one identity with one of its shapes and its gains. The single effects are fitted in
// turn to the residual of the others until the bound stops rising. Then another one is added, until the next has less
// than half a unit of probability.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "diagnosis/posterior/columns_at.hpp"

namespace ballbar {

// The posterior of one single effect.
struct SinglePrior {
  double log_none = 0.0;
  std::vector<double> log_identity;
};

struct SingleEffect {
  double log_weight = kLogZero;        // ln of the weight of any identity relative to none
  std::vector<double> p;               // of each identity; the remainder is that of nothing
  std::vector<std::size_t> likeliest;  // most likely shape of each identity, index into Identities::shapes
  std::vector<double> strength;        // ln of the weight of that shape, for a P that underflows
  std::vector<std::pair<Eigen::Index, double>> mean;  // coefficients of columns
  ColumnsAt::Curve curve;                             // of the mean
  double spread = 0.0;                                // expected sum of squares of its curve, in units of the scatter
  double divergence = 0.0;                            // of the posterior from the prior
  double p_any() const;
  double p_none() const;  // accurate even if far below 1
};

struct Ascent {
  std::vector<SingleEffect> effects;  // the last one has less than half, or the largest number is reached
  double bound = 0.0;                 // lower bound of ln of the evidence
  double variance = 0.0;              // of the scatter
};

struct AscentOptions {
  std::vector<SinglePrior> priors;     // of each single effect; the last one applies to all further ones
  std::size_t least = 0, largest = 0;  // number of single effects
  KnownScatter known;
  double least_variance = 0.0;  // of the scatter, from rounding
};

// start: the initial state. Settles the columns at the scatter found.
Ascent ascended(ColumnsAt& at, const Identities& identities, const AscentOptions& options, Ascent start = {});

}  // namespace ballbar

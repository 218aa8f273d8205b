// A covariance, and the sum of single effects that the ascent finds there.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "diagnosis/posterior/ascent.hpp"
#include "diagnosis/posterior/columns_at.hpp"

namespace ballbar {

struct Found {
  Point point;
  double background = 0.0;  // d of a little of every input
  Ascent ascent;
  double log_weight = kLogZero;                        // bound and prior of the covariance
  std::vector<std::pair<std::size_t, double>> shares;  // of the background, by family
};

// Falls from the likeliest.
void sort_found(std::vector<Found>& found);

// largest: number of single effects. without: an identity that none of them may be, or kNoSignature.
AscentOptions ascent_options(const Problem& problem, const Identities& identities, std::size_t largest,
                             std::size_t without = kNoSignature);

// A block of many columns can stand in for several effects: the ascent begins with it, and without it.
Ascent best_ascent(ColumnsAt& at, const Problem& problem, const Identities& identities, const AscentOptions& options,
                   const Ascent& start);

// From where each single effect is one of these identities.
Ascent ascended_from(ColumnsAt& at, const Identities& identities, const AscentOptions& options,
                     const std::vector<std::size_t>& set);

std::size_t likeliest_identity(const SingleEffect& one);

// That of each single effect that is likelier there than not.
std::vector<std::size_t> likeliest_set(const Ascent& ascent);

DenseBackground background_of(const Problem& problem, double d);

}  // namespace ballbar

// A covariance, and the sum of single effects that the ascent finds there.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "diagnosis/posterior/ascent.hpp"
#include "diagnosis/posterior/columns_at.hpp"

namespace ballbar {

struct WeightedAscent {
  Point point;
  Ascent ascent;
  double log_weight = kLogZero;  // lower bound plus ln prior of the covariance
};

// Sorted, the most likely first.
void sort_by_weight(std::vector<WeightedAscent>& found);

// Whether inputs in any form are identities. While the shapes of effects are as coarse as their grid they are not: the
// error of the grid is many times the noise where an effect is large, and a form would take it.
enum class Forms { no, yes };

// largest: largest number of single effects. without: an identity to exclude, or kNoSignature.
AscentOptions ascent_options(const Problem& problem, const Identities& identities, std::size_t largest, Forms forms,
                             std::size_t without = kNoSignature);

// Starts the ascent with one single effect for each of these identities; with none, anew.
Ascent ascended_from(ColumnsAt& at, const Identities& identities, const AscentOptions& options,
                     const std::vector<std::size_t>& set);

std::size_t likeliest_identity(const SingleEffect& one);

// The identity of each single effect that is more likely present than absent.
std::vector<std::size_t> likeliest_set(const Ascent& ascent);

// The readings less what the single effects explain on average.
Variant beside_mean_of(const Ascent& ascent, const Identities& identities, Variant variant);

}  // namespace ballbar

// The distribution of the sum of a few scores, by convolution of their empirical distribution.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "history/scatter.hpp"

namespace ballbar {

inline constexpr double kTailStep = 0.1;  // of a score

// Counts of scores by absolute size in steps; the last one has all beyond kShortRunClip.
class TailCounts {
 public:
  void add(std::span<const double> scores);

  std::array<double, 61> counts{};
  double total = 0.0;
};

// P(sum of k + 1 scores >= i steps), i from 0. If there are few scores, those of all quantities are included, with a
// few of Student's t with 4 degrees of freedom.
std::array<std::vector<double>, kLongestShortRun> tails_of(const TailCounts& own, const TailCounts& of_all);

// Of one score, from its tail.
double variance_of(const std::vector<double>& tail);

// On either side.
double chance_of_sum(const std::vector<double>& tail, double sum);

}  // namespace ballbar

// How likely the sum of a few scores is that large: their distribution in the tests, and its convolutions.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "history/scatter.hpp"

namespace ballbar {

inline constexpr double kTailStep = 0.1;  // of a score

// How many scores were that large, on either side of 0, in steps; the last holds all beyond kShortRunClip.
class TailCounts {
 public:
  void add(std::span<const double> scores);

  std::array<double, 61> counts{};
  double total = 0.0;
};

// P(sum of k + 1 scores >= i steps), i from 0. Where there are few, those of all quantities count too, with
// a few of Student's t with 4 degrees of freedom.
std::array<std::vector<double>, kLongestShortRun> tails_of(const TailCounts& own, const TailCounts& of_all);

// Of one score, from its tail.
double variance_of(const std::vector<double>& tail);

// On either side.
double chance_of_sum(const std::vector<double>& tail, double sum);

}  // namespace ballbar

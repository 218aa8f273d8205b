// How much each quantity scatters from test to test, how heavy the tails are, and what memory the scatter has: learnt
// from all machines.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "history/quantity_series.hpp"

namespace ballbar {

// Of one series. s^2 = (d0 s0^2 + d r^2) / (d0 + d), r from successive values, s0 and d0 from the same quantity of all
// machines (Smyth 2004).
struct SeriesScatter {
  double s = 0.0;            // 0: all values are the same
  double degrees = 0.0;      // d0 + d
  bool of_machines = false;  // s0 is known: there are kSeriesOfPrior series of the quantity at least
};

inline constexpr std::size_t kRunLengths = 9;
inline constexpr std::array<std::size_t, kRunLengths> kRunLength{1, 2, 3, 4, 6, 8, 12, 16, 24};
inline constexpr std::size_t kLongestShortRun = 12;
inline constexpr double kShortRunClip = 6.0;

// Of one quantity in one plane on all machines.
class FamilyScatter {
 public:
  // Variance of the mean of j successive values over that of independent ones, at least 1.
  double memory(double j) const;
  // The same of very many, for what follows a series from end to end: as far as it still rises up to j.
  double memory_beyond(double j) const;
  // That the mean of j <= kLongestShortRun successive scores, each clipped at kShortRunClip, is so far from 0 by
  // chance, on either side.
  double chance_of_mean(std::size_t j, double mean) const;

  std::array<double, kRunLengths> memory_of{1, 1, 1, 1, 1, 1, 1, 1, 1};
  double variance_of_score = 1.0;                          // clipped at kShortRunClip
  std::array<std::vector<double>, kLongestShortRun> tail;  // of the sum of 1, 2 ... scores: at least so many steps
};

struct Scatter {
  std::vector<SeriesScatter> series;
  std::vector<FamilyScatter> families;
};

// Scatters of the values of a series: s, more where a value's own sigma is larger than the usual one.
std::vector<double> scatters_of(const QuantitySeries& series, double s);

Scatter scatter_of(const AllSeries& all);

}  // namespace ballbar

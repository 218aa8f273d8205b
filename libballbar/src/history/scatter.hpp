// The scatter of each quantity from test to test, with its tails and its correlation, estimated from all machines.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "history/quantity_series.hpp"

namespace ballbar {

// The scatter of one series: s^2 = (d0 s0^2 + d r^2) / (d0 + d), with r from successive values, s0 and d0 from the same
// quantity of all machines (Smyth 2004).
struct SeriesScatter {
  double s = 0.0;            // 0: all values are equal
  double degrees = 0.0;      // d0 + d
  bool of_machines = false;  // s0 is known, from at least kSeriesOfPrior series of the quantity
};

inline constexpr std::size_t kRunLengths = 9;
inline constexpr std::array<std::size_t, kRunLengths> kRunLength{1, 2, 3, 4, 6, 8, 12, 16, 24};
inline constexpr std::size_t kLongestShortRun = 12;
inline constexpr double kShortRunClip = 6.0;

// The scatter of one quantity in one plane on all machines.
class FamilyScatter {
 public:
  // Variance of the mean of j successive values, relative to independent ones; at least 1.
  double memory(double j) const;
  // The same for very many values, for curves over a whole series: extrapolated as far as it still rises up to j.
  double memory_beyond(double j) const;
  // Two-sided p-value of the mean of j <= kLongestShortRun successive scores, each clipped at kShortRunClip.
  double chance_of_mean(std::size_t j, double mean) const;

  std::array<double, kRunLengths> memory_of{1, 1, 1, 1, 1, 1, 1, 1, 1};
  double variance_of_score = 1.0;                          // of a score clipped at kShortRunClip
  std::array<std::vector<double>, kLongestShortRun> tail;  // of the sum of 1, 2 ... scores, by number of steps
};

struct Scatter {
  std::vector<SeriesScatter> series;
  std::vector<FamilyScatter> families;
};

// The scatter of each value of a series: s, and more if the sigma of the value is larger than usual.
std::vector<double> scatters_of(const QuantitySeries& series, double s);

Scatter scatter_of(const AllSeries& all);

}  // namespace ballbar

// How well two drift series agree, axis by axis: a (the ballbar) against b (the five probes).
//
// Common times are those of the series with fewer rows where the other one covers them; the other is interpolated
// linearly, never beyond its ends and never across a gap. Both are taken as changes since the first common time, so
// that different zeros do not count as disagreement. d = a - b:
//
//   mean relative deviation     mean |d| / |b| over samples with |b| above a tenth of the range of b (He 2015)
//   of the range                mean |d| / (max b - min b)
//   bias, limits of agreement   mean of d, mean -+ 1.96 standard deviations of d (Bland, Altman 1986)
//   lag                         the shift of a's clock for which a(t) and b(t - lag) + constant agree best; positive: a
//   is late
//
// Uncertainty. sigma of d: root of the sum of the squared contributions of both (law of propagation); interpolated
// linearly between rows; where the zero is moved to another row, that row's is added as an independent one: too
// large where the two share an error, too small by a factor of at most sqrt(2) where an error that grows with the
// reading (probe linearity) meets readings of opposite sign. A sample agrees if |d| <= 2 sigma; where sigma is infinite
// (undetermined) it does not count. An axis disagrees if more samples do not agree than chance allows (p < 1 %;
// binomial, half of each variance an error that all samples share, that of the zero), or one lies farther out than the
// largest of so many would (p < 1 %). Other errors that samples share, such as a probe's linearity, make it wrong more
// often. It disagrees, too, where scale, clock, offset or drift of the difference stand out (difference_structure.hpp):
// half of the usual variance of each side is taken for the zero's.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/difference_structure.hpp"
#include "ballbar/drift/measured_drift.hpp"

namespace ballbar {

enum class Agreement { agrees, disagrees, cannot_tell };

struct UncertaintyShare {
  std::string source;
  double sigma = 0.0;     // root mean square over the samples, in the axis' unit; NaN: none known or determined
  double variance = 0.0;  // share of the variance of d, 0 to 1; 0 where sigma is NaN
};

struct Deviation {
  double from_s = 0.0;  // the stretch of samples beyond 2 sigma, all on one side, that holds the worst
  double to_s = 0.0;
  bool to_the_end = false;
  double largest = 0.0;  // d of the worst sample there (largest |d| / sigma)
  double sigma = 0.0;
  double at_s = 0.0;
};

struct AxisComparison {
  std::string name, unit;
  std::vector<double> time_s, a, b, difference, sigma;  // n samples; sigma NaN: not stated, infinite: not determined
  Agreement agreement = Agreement::cannot_tell;
  bool samples_agree = true;                      // one by one; `agreement` needs `structure` not to stand out besides
  std::optional<Deviation> deviation;             // where some sample is beyond 2 sigma
  std::optional<double> mean_relative_deviation;  // nothing: b does not move
  std::optional<double> expected_relative_deviation;  // mean of sqrt(2/pi) sigma / |b| over the same samples
  std::optional<double> explained_share;              // of the first by the second, at most 1
  std::optional<double> range_deviation;
  double rmse = 0.0;
  double largest = 0.0;  // d of the largest |d|
  double largest_s = 0.0;
  double bias = 0.0;
  std::optional<double> limit_low, limit_high;  // nothing: fewer than 2 samples after the reference
  std::size_t within = 0;                       // samples that agree, the reference left out
  std::size_t counted = 0;                      // samples with a finite sigma, the reference left out
  std::optional<double> correlation;
  std::optional<double> lag_s, lag_sigma_s;  // nothing: none within a quarter of the common time, or no bend
  std::vector<UncertaintyShare> budget;
  std::optional<DifferenceStructure> structure;  // nothing: too few samples
};

struct ComparisonOptions {
  std::optional<double> reference_s;  // the common time nearest to it; nothing: the first
  std::optional<double> max_gap_s;    // rows farther apart are not interpolated between; nothing: 4 median steps
};

struct Comparison {
  std::string a, b;
  double reference_s = 0.0;
  std::size_t samples = 0;   // common times
  std::size_t left_out = 0;  // times within both that fall into a gap of the interpolated series
  std::vector<AxisComparison> axes;
  std::vector<std::string> remarks;
};

// Axes of the same name. Throws Error: no axis in common, an axis in different units, time ranges that do not overlap,
// a series without rows, fewer than 3 common times.
Comparison compare(const MeasuredDrift& a, const MeasuredDrift& b, const ComparisonOptions& options = {});

// The conclusion first: agree or not, which axis, since when, by how much.
std::string conclusion(const Comparison& comparison);

}  // namespace ballbar

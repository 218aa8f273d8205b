// How well two drift series agree, axis by axis: a (the ballbar) against b (the five probes).
//
// The common times are those of the series with fewer rows, as far as the other one covers them. The other one is
// interpolated linearly, never beyond its ends and never across a gap. Both are changes since the first common time, so
// that different zeros do not count as disagreement. d = a - b:
//
//   mean relative deviation     mean |d| / |b| over samples with |b| above a tenth of the range of b (He 2015)
//   of the range                mean |d| / (max b - min b)
//   bias, limits of agreement   mean of d, mean -+ 1.96 standard deviations of d (Bland, Altman 1986)
//   lag                         the shift of a's clock for which a(t) and b(t - lag) + constant agree best; positive if
//                               a is late
//
// Uncertainty. sigma of d is the root of the sum of the squared contributions of both series (law of propagation),
// interpolated linearly between rows. Where the zero moves to another row, the sigma of that row is added as
// independent. This is too large if the two rows share an error. It is too small by a factor of at most sqrt(2) if an
// error that grows with the reading (probe linearity) meets readings of opposite sign.
//
// A sample agrees if |d| <= 2 sigma. Samples with infinite sigma (undetermined) do not count. An axis disagrees in one
// of three cases:
//   - more samples disagree than chance allows: p < 1 %, binomial, where half of each variance is an error shared by
//     all samples, that of the zero;
//   - one sample lies farther out than the largest of so many would: p < 1 %;
//   - scale, clock, offset or drift of the difference are significant (difference_structure.hpp); half of the usual
//     variance of each side is taken as that of the zero.
// Other shared errors, such as the linearity of a probe, raise the rate of false disagreement.
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
  double from_s = 0.0;  // the run of samples beyond 2 sigma on one side that contains the worst one
  double to_s = 0.0;
  bool to_the_end = false;
  double largest = 0.0;  // d of the worst sample (largest |d| / sigma)
  double sigma = 0.0;
  double at_s = 0.0;
};

struct AxisComparison {
  std::string name, unit;
  std::vector<double> time_s, a, b, difference, sigma;  // n samples; sigma NaN: not stated, infinite: not determined
  Agreement agreement = Agreement::cannot_tell;
  bool samples_agree = true;                      // judged one by one; `agreement` takes `structure` into account too
  std::optional<Deviation> deviation;             // nullopt: no sample beyond 2 sigma
  std::optional<double> mean_relative_deviation;  // nullopt: b is constant
  std::optional<double> expected_relative_deviation;  // mean of sqrt(2/pi) sigma / |b| over the same samples
  std::optional<double> explained_share;              // the second over the first, at most 1
  std::optional<double> range_deviation;
  double rmse = 0.0;
  double largest = 0.0;  // d of the largest |d|
  double largest_s = 0.0;
  double bias = 0.0;
  std::optional<double> limit_low, limit_high;  // nullopt: fewer than 2 samples after the reference
  std::size_t within = 0;                       // number of samples that agree, without the reference
  std::size_t counted = 0;                      // number of samples with a finite sigma, without the reference
  std::optional<double> correlation;
  std::optional<double> lag_s, lag_sigma_s;  // nullopt: no lag within a quarter of the common time, or straight curves
  std::vector<UncertaintyShare> budget;
  std::optional<DifferenceStructure> structure;  // nullopt: too few samples
};

struct ComparisonOptions {
  std::optional<double> reference_s;  // the nearest common time is the reference; nullopt: the first
  std::optional<double> max_gap_s;    // longest gap to interpolate across; nullopt: 4 median steps
};

struct Comparison {
  std::string a, b;
  double reference_s = 0.0;
  std::size_t samples = 0;   // common times
  std::size_t left_out = 0;  // times within both series that fall into a gap of the interpolated one
  std::vector<AxisComparison> axes;
  std::vector<Paragraph> remarks;
};

// Compares axes of the same name. Throws Error: no common axis, an axis in different units, time ranges that do not
// overlap, a series without rows, fewer than 3 common times.
Comparison compare(const MeasuredDrift& a, const MeasuredDrift& b, const ComparisonOptions& options = {});

// One clock that is late: the lags of best agreement of two axes or more, which are the same within 3 sigma and not 0,
// where some axis disagrees. An axis that a scale explains better has no lag.
struct CommonLag {
  double lag_s = 0.0, sigma_s = 0.0;  // positive: A is late
  std::vector<std::string> axes;      // that have a lag
};
std::optional<CommonLag> common_lag(const Comparison& comparison);

}  // namespace ballbar

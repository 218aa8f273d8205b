// How well two drift series agree, axis by axis, and what kind of error lies between them: a scale, a clock, an offset,
// a drift of one of them. Used for a ballbar against five probes, and for a model against either.
//
//   compare()               agreement of each axis with its uncertainty budget
//   difference_structure()  the four parts of a difference
//
// Accuracy: of comparisons of equal series at most 1 % disagree for each criterion; the lag of simulated drifts is
// within 2 sigma of the truth in 90 to 99 % (tests/study, five_probe.cpp).
//
// ---- The parts of a difference.
//
// Splits the difference of two drifts into a scale error, a clock error, an offset and a drift of one of them.
//
//   b(t) = offset + gain a(t + lag) + drift (t - t_0) + noise,   a and b changes since t_0
//
// Both series have independent errors in each row, an error of the reference point that all rows share, and other
// shared errors of a stated shape (probe linearity). The covariance of b - gain a is
//
//   V = diag(s_b^2 + gain^2 s_a^2) + (r_b^2 + gain^2 r_a^2) 1 1' + sum h h'
//
// Estimates minimise r' V^-1 r, r the residual. With gain and offset alone this is Deming regression (York's if the
// sigmas differ). The tests take "no difference" as the null hypothesis: they regress b - a on 1, on the mean of a and
// b weighted by 1 / s^2, on its slope, and on t. The errors of that mean are independent of those of b - a. Each
// estimate / sigma is therefore standard normal under the null hypothesis, however noisy both are. Each of the four is
// tested with the other three free; all four together by chi^2.
//
// The slope is that of a parabola through at least 3 rows, 1/30 of the rows. If the parabolas do not fit the rows, the
// rows are too sparse for a lag. The sigmas are widened if the residual after the four is too large for them (p < 1 %)
// or autocorrelated. If none is stated, they come from the median of that residual, equal for a and b. O(n) in rows.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"

namespace ballbar {

enum class DifferenceKind { offset, gain, lag, drift };
inline constexpr std::array kDifferenceKinds{DifferenceKind::offset, DifferenceKind::gain, DifferenceKind::lag,
                                             DifferenceKind::drift};

struct DifferenceRows {
  std::vector<double> time_s, a, b;            // n rows
  std::size_t zero = 0;                        // reference row of a and b; it does not count
  std::vector<double> variance_a, variance_b;  // n rows, independent part; not finite: the row does not count
  double reference_variance_a = 0.0, reference_variance_b = 0.0;
  std::vector<std::vector<double>> shared;  // signed sigma, n rows each
  bool stated = true;                       // false: variances are unknown and those above are ignored
  std::string unit;                         // of a and b
};

struct DifferencePart {
  double value = 0.0;  // of a gain 1: no error; of a lag positive: a is late
  double sigma = 0.0;
  double explains = 0.0;  // chi^2
  double chance = 1.0;    // p-value
  bool named = false;     // chance below the limit
  std::string unit;       // of value and sigma: that of the axis, none, s, um_per_h
};

// As kDifferenceKinds. nullopt: not determined, because the rows do not tell it from the others; or it does not stand
// out (p > 1 %) and its sigma is above half of the scale, a quarter of the time, the range of the drifts, or that range
// over the time.
using DifferenceParts = std::array<std::optional<DifferencePart>, 4>;

// Squares of a difference in units of its scatter, summed up.
struct ChiSquare {
  double chi2 = 0.0;
  std::size_t freedom = 0;
  std::optional<double> chance, limit;  // p-value, and below which that counts; nullopt: not judged
};

enum class NoiseOfDifference { stated, widened, from_rows };

struct DifferenceStructure {
  DifferenceParts parts;  // each estimated with the others free
  DifferenceParts alone;  // each estimated with the others absent
  ChiSquare whole;        // of the whole difference; freedom: the rows that count
  ChiSquare together;     // part of it that the four explain, 1 to 4 degrees; limit 1 % / (5 axes), as of `alone`
  NoiseOfDifference noise = NoiseOfDifference::stated;
  double widened_by = 1.0;     // factor on sigma; from_rows: sigma of b - a in a row, in the axis' unit
  bool stands_out = false;     // a part is named, in `parts` or `alone`, or together below its limit
  double limit_of_part = 0.0;  // 1 % / (4 axes): for `parts`
  std::string unit;            // of the axis
};

// Returns nullopt for fewer than 6 rows that count, or fewer than 12 if no variance is stated.
std::optional<DifferenceStructure> difference_structure(const DifferenceRows& rows);

// Applies Bonferroni's correction for the number of axes. Of comparisons of equal series at most 1 % name one of
// `parts`. At most 1 % more are significant by all four together or by one alone, the more powerful test for a single
// fault.
DifferenceStructure judged(DifferenceStructure structure, std::size_t axes);

// The kinds each of which explains the difference by itself: the other three add nothing significant (p > 1 %).
std::vector<DifferenceKind> sufficient_alone(const DifferenceStructure& structure);

// Those named beside all others, by how much they explain, the largest first.
std::vector<DifferenceKind> named_differences(const DifferenceStructure& structure);

// ---- How well two drift series agree, axis by axis: a (the ballbar) against b (the five probes).
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
//   - scale, clock, offset or drift of the difference are significant (compare.hpp); half of the usual
//     variance of each side is taken as that of the zero.
// Other shared errors, such as the linearity of a probe, raise the rate of false disagreement.

enum class Agreement { agrees, disagrees, cannot_tell };

struct UncertaintyShare {
  std::string source;
  double sigma = 0.0;     // root mean square over the samples; NaN: none known or determined
  double variance = 0.0;  // share of the variance of d, 0 to 1; 0 where sigma is NaN
  std::string unit;       // of sigma
};

struct Deviation {
  double from_s = 0.0;  // the run of samples beyond 2 sigma on one side that contains the worst one
  double to_s = 0.0;
  bool to_the_end = false;
  double largest = 0.0;  // d of the worst sample (largest |d| / sigma)
  double sigma = 0.0;
  double at_s = 0.0;
  std::string unit;  // of both
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

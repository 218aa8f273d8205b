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
#include <vector>

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
};

struct DifferencePart {
  double value = 0.0;  // offset in the axis' unit; gain (1: no error); lag in s, positive if a is late; drift per h
  double sigma = 0.0;
  double explains = 0.0;  // chi^2
  double chance = 1.0;    // p-value
  bool named = false;     // chance below the limit
};

// As kDifferenceKinds. nullopt: not determined, because the rows do not tell it from the others; or it does not stand
// out (p > 1 %) and its sigma is above half of the scale, a quarter of the time, the range of the drifts, or that range
// over the time.
using DifferenceParts = std::array<std::optional<DifferencePart>, 4>;

enum class NoiseOfDifference { stated, widened, from_rows };

struct DifferenceStructure {
  std::size_t rows = 0;           // number of rows that count
  DifferenceParts parts;          // each estimated with the others free
  DifferenceParts alone;          // each estimated with the others absent
  double chi2 = 0.0;              // of the whole difference, `rows` degrees of freedom
  double chi2_of_parts = 0.0;     // part of chi2 that the four explain
  std::size_t parts_freedom = 0;  // 1 to 4
  double chance_of_parts = 1.0;
  NoiseOfDifference noise = NoiseOfDifference::stated;
  double widened_by = 1.0;      // factor on sigma; from_rows: sigma of b - a in a row, in the axis' unit
  bool stands_out = false;      // a part is named, in `parts` or `alone`, or chance_of_parts is below its limit
  double limit_of_part = 0.0;   // 1 % / (4 axes): for `parts`
  double limit_of_parts = 0.0;  // 1 % / (5 axes): for all four together, and for `alone`
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

}  // namespace ballbar

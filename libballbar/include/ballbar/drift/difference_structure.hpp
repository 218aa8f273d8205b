// What the difference of two drifts is made of: a wrong scale, a clock, an offset, a drift of one of them.
//
//   b(t) = offset + gain a(t + lag) + drift (t - t_0) + noise,   a and b changes since t_0
//
// Both have errors: their own of each row, one that all rows of a series share because each is a change since its
// reference point, and others that all rows share in a stated shape (probe linearity). The covariance of b - gain a is
//
//   V = diag(s_b^2 + gain^2 s_a^2) + (r_b^2 + gain^2 r_a^2) 1 1' + sum h h'
//
// Estimates minimise rest' V^-1 rest: for gain and offset alone Deming's regression (York's where the sigmas differ).
// Tests are made at "no difference": b - a on 1, the mean of a and b weighted by 1 / s^2, its slope, t. The errors of
// that mean are independent of those of b - a, so that each estimate / sigma is standard normal where a and b do not
// differ, however noisy both are. Each of the four with the other three free; all four together by chi^2.
//
// The slope is that of a parabola through 3 rows or more, 1/30 of the rows; where those parabolas do not follow the
// rows, the rows are too sparse for a lag. The sigmas are widened where the rest after the four is too large for them
// (p < 1 %) or autocorrelated; where none is stated they are found from the median of that rest, alike for a and b.
// O(n) in rows.
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
  std::size_t zero = 0;                        // the row since which a and b are changes: it does not count
  std::vector<double> variance_a, variance_b;  // n rows, each row's own; not finite: the row does not count
  double reference_variance_a = 0.0, reference_variance_b = 0.0;
  std::vector<std::vector<double>> shared;  // sigma with its sign, n rows each
  bool stated = true;                       // false: variances are not known, those above are not read
};

struct DifferencePart {
  double value = 0.0;  // offset in the axis' unit; gain, 1: none; lag in s, positive: a is late; drift in unit per h
  double sigma = 0.0;
  double explains = 0.0;  // chi^2
  double chance = 1.0;    // of an estimate as far from none where a and b do not differ
  bool named = false;     // chance below the limit
};

using DifferenceParts = std::array<std::optional<DifferencePart>, 4>;  // as kDifferenceKinds; nothing: cannot be told

enum class NoiseOfDifference { stated, widened, from_rows };

struct DifferenceStructure {
  std::size_t rows = 0;           // that count
  DifferenceParts parts;          // each with the others free
  DifferenceParts alone;          // each with the others none
  double chi2 = 0.0;              // of the whole difference, `rows` degrees of freedom
  double chi2_of_parts = 0.0;     // of that what the four explain
  std::size_t parts_freedom = 0;  // 1 to 4
  double chance_of_parts = 1.0;
  NoiseOfDifference noise = NoiseOfDifference::stated;
  double widened_by = 1.0;      // sigma; from_rows: sigma of b - a in a row, in the axis' unit
  bool stands_out = false;      // a part is named, in `parts` or `alone`, or chance_of_parts is below its limit
  double limit_of_part = 0.0;   // 1 % / (4 axes): of `parts`
  double limit_of_parts = 0.0;  // 1 % / (5 axes): of all four together, and of `alone`
};

// Nothing: fewer than 6 rows that count, 12 where no variance is stated.
std::optional<DifferenceStructure> difference_structure(const DifferenceRows& rows);

// Bonferroni: of all comparisons of series that do not differ at most 1 % name one of `parts`, and at most 1 % more
// stand out by all four together or by one alone, which is the sharper test where only one thing is wrong.
DifferenceStructure judged(DifferenceStructure structure, std::size_t axes);

// The one kind, or those, which alone leave nothing that chance would not: p > 1 % of what the four explain beyond it.
std::vector<DifferenceKind> sufficient_alone(const DifferenceStructure& structure);

}  // namespace ballbar

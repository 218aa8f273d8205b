// A smooth curve through noisy rows, and what noise adds to its range.
//
// The curve is a cubic smoothing spline: an integrated Wiener process observed with white noise, by a Kalman filter and
// a Rauch-Tung-Striebel smoother. The ratio of the two variances is that of the largest restricted likelihood.
// G. Wahba, J. R. Statist. Soc. B 40 (1978); W. F. Wecker and C. F. Ansley, J. Am. Statist. Assoc. 78 (1983). What the
// spline leaves is smoothed once more and added (twicing: J. W. Tukey, Exploratory Data Analysis (1977)).
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "ballbar/drift/drift.hpp"

namespace ballbar {

inline constexpr std::size_t kFewestForCurve = 30;  // rows of a range or a largest drift by a curve
inline constexpr std::size_t kMostOfCurve = 3000;   // of more rows the means of neighbours

// Replaces rows by means of as many neighbours as leave at most this many; the last few are left out. Returns how many.
std::size_t average_blocks(std::vector<double>& time_s, std::vector<double>& values, std::size_t most);

// Largest less smallest value of the curve within each window of rows [first, last), freed of the bias of noise, and
// its sigma, by a parametric bootstrap: noise is added to the curve 60 times, and the curve made anew (B. Efron and
// R. J. Tibshirani, An Introduction to the Bootstrap (1993), chapter 10). Rows without gaps, times rising; at least 3.
std::vector<Estimate> smooth_ranges(std::span<const double> time_s, std::span<const double> values,
                                    std::span<const std::pair<std::size_t, std::size_t>> windows);

// The curve less its value in the row `reference`, each with its sigma by the same bootstrap.
std::vector<Estimate> smooth_changes(std::span<const double> time_s, std::span<const double> values,
                                     std::size_t reference);

}  // namespace ballbar

// What was found in single quantities, of which events are made.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ballbar/history/history.hpp"
#include "history/quantity_series.hpp"
#include "history/robust_fit.hpp"
#include "history/scatter.hpp"
#include "history/series_judgement.hpp"

namespace ballbar {

// One p value, with q: of FindingKind::step, trend, season, or instrument (a step where the bar is exchanged).
struct Call {
  std::size_t series = 0;  // place in AllSeries::series
  FindingKind kind = FindingKind::step;
  double p_value = 1.0, q_value = 1.0;
  StepPlace place;
  // Of the curve with all that was found in the series.
  double size = 0.0, sigma = 0.0;
  double before = 0.0, after = 0.0;  // levels on either side of a step
  double peak_year = 0.0;            // of a season: where in the year it is highest, 0 to 1
};

inline const QuantitySeries& series_of(const AllSeries& all, const Call& call) { return all.series[call.series]; }

// All p values with their q; in the order of the series.
std::vector<Call> calls_of(const AllSeries& all, const Scatter& scatter);

// The curve of a series with these calls, all of it: level, steps, trend, season.
struct SeriesCurve {
  std::vector<double> fitted;
  double level = 0.0, sigma = 0.0;  // at the last value
};

// Fits it and completes size, sigma and levels of the calls.
SeriesCurve curve_with(const QuantitySeries& series, const SeriesScatter& scatter, const FamilyScatter& family,
                       const std::vector<Call*>& calls);

// p values of many questions at a time.

// q of each: of those with q below a rate no larger share is by chance (Benjamini and Hochberg 1995),
// for p values that are independent or rise and fall together. O(n log n).
std::vector<double> q_values(std::span<const double> p_values);

// That nothing at all is behind these (Simes 1986): min of n p_(i) / i. 1 of none.
double simes(std::vector<double> p_values);

}  // namespace ballbar

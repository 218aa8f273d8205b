// Findings in single quantities, which are later combined into events.
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

// One p-value with its q, of FindingKind::step, trend, season, or instrument (a step at a change of the bar).
struct Call {
  std::size_t series = 0;  // index into AllSeries::series
  FindingKind kind = FindingKind::step;
  double p_value = 1.0, q_value = 1.0;
  StepPlace place;
  // From the curve with all findings of the series.
  double size = 0.0, sigma = 0.0;
  double before = 0.0, after = 0.0;  // levels on either side of a step
  double peak_year = 0.0;            // season: time of its maximum in the year, 0 to 1
};

inline const QuantitySeries& series_of(const AllSeries& all, const Call& call) { return all.series[call.series]; }

// All p-values with their q, in the order of the series.
std::vector<Call> calls_of(const AllSeries& all, const Scatter& scatter);

// The complete curve of a series with these findings: level, steps, trend, season.
struct SeriesCurve {
  std::vector<double> fitted;
  double level = 0.0, sigma = 0.0;  // at the last value
};

// Fits it and completes size, sigma and levels of the calls.
SeriesCurve curve_with(const QuantitySeries& series, const SeriesScatter& scatter, const FamilyScatter& family,
                       const std::vector<Call*>& calls);

// Corrections for many p-values.

// The q-value of each: of those with q below a rate at most that share is by chance (Benjamini and Hochberg 1995), for
// p-values that are independent or positively dependent. O(n log n).
std::vector<double> q_values(std::span<const double> p_values);

// The joint p-value of all null hypotheses (Simes 1986): min of n p_(i) / i; 1 without p-values.
double simes(std::vector<double> p_values);

}  // namespace ballbar

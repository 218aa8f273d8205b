// One quantity of one machine over time: is there a step, a trend, a season, or nothing?
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "ballbar/history/history.hpp"
#include "ballbar/history/trend.hpp"
#include "history/quantity_series.hpp"
#include "history/scatter.hpp"

namespace ballbar {

// Where the level changes: at place k, the first value after it.
struct StepPlace {
  std::size_t at = 0;
  std::size_t earliest = 0, latest = 0;  // that are about as likely
};

// p values; nothing: too few values, or too short a time.
struct SeriesJudgement {
  std::optional<double> p_step, p_trend, p_season;
  StepPlace step;
  std::optional<FindingKind> best;  // the curve that leaves least, a penalty for its constants added
  // Of scales: that they step where the bar is exchanged, FindingKind::instrument among the curves.
  std::optional<double> p_bar;
  std::size_t bar_at = 0;
};

// The best curve is judged against a level. Where it is clear, the others are judged together with it: their p value is
// the larger of that and of the one against a level. Steps are searched at every place with two values on either side,
// and their p value is multiplied by the number of places. O(n).
SeriesJudgement judgement_of(const QuantitySeries& series, const SeriesScatter& scatter, const FamilyScatter& family);

// The straight line through the values from place `first` on.
std::optional<Trend> trend_since(const QuantitySeries& series, std::size_t first);

// Of all axes together; and that, or of one axis: what the length of the bar shows in.
bool is_global_scale(std::string_view name);
bool is_scale(std::string_view name);

}  // namespace ballbar

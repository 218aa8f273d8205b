// Tests one quantity of one machine over time for a step, a trend and a season.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "ballbar/history/history.hpp"
#include "history/quantity_series.hpp"
#include "history/scatter.hpp"

namespace ballbar {

// The position of a step: index k of the first value after it.
struct StepPlace {
  std::size_t at = 0;
  std::size_t earliest = 0, latest = 0;  // range of positions that are about equally likely
};

// p-values; nullopt: too few values, or too short a time.
struct SeriesJudgement {
  std::optional<double> p_step, p_trend, p_season;
  StepPlace step;
  std::optional<FindingKind> best;  // the best curve, with a penalty for its parameters
  // For scales: the step at a change of the bar, the curve FindingKind::instrument.
  std::optional<double> p_bar;
  std::size_t bar_at = 0;
};

// The best curve is tested against a constant. If it is significant, the others are tested in addition to it; their
// p-value is the larger of this one and that against a constant. Steps are searched at every index with two values on
// either side, and their p-value is multiplied by the number of positions. O(n).
SeriesJudgement judgement_of(const QuantitySeries& series, const SeriesScatter& scatter, const FamilyScatter& family);

// The straight line through the values from index `first` on.
std::optional<Trend> trend_since(const QuantitySeries& series, std::size_t first);

// Whether a quantity is of all axes together; and whether it depends on the length of the bar (also one of one axis).
bool is_global_scale(std::string_view name);
bool is_scale(std::string_view name);

}  // namespace ballbar

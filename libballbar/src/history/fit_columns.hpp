// The columns of the curves that values over time are held against.
#pragma once

#include <span>

#include "history/robust_fit.hpp"

namespace ballbar {

// 1, and years since the middle of the dates.
FitColumns trend_columns(std::span<const double> time_s);

// sin and cos of the time of the year; each of 1970-01-01T00:00:00 begins one.
FitColumns season_columns(std::span<const double> time_s);

// 0 before place k, 1 from it on.
FitColumns step_column(std::size_t n, std::size_t k);

// Two sets side by side.
FitColumns joined(const FitColumns& left, const FitColumns& right);

}  // namespace ballbar

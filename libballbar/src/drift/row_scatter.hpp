// The scatter of single readings about a slow drift.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace ballbar {

inline constexpr std::size_t kRowsForScatter = 6;

// Standard deviation of a reading, from its distance to the line through its two neighbours; the largest 5 % of the
// squares are left out, as jumps are. nullopt: fewer than kRowsForScatter rows in a row without a gap.
std::optional<double> row_scatter(std::span<const double> time_s, std::span<const double> value);

}  // namespace ballbar

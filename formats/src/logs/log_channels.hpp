// Channels below each other: each row has the name of a channel, its time and its value.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "logs/column_sample.hpp"
#include "logs/log_plan.hpp"
#include "logs/log_table.hpp"

namespace ballbar {

// Finds the column with the names of channels, where there is one: its words come back, the time rises within each of
// them but not from row to row; or, where the time rises from row to row too, the values go on from those of the same
// word and jump from one word to another. Sets its kind to ColumnKind::channel, and the units of channels. Throws Error
// with name:line where the rows may be one table as well.
void find_channels(const LogShape& shape, const std::vector<ColumnSample>& samples, const std::string& name,
                   LogPlan& plan);

// A column for each channel, and a row for each time. A channel has a gap where it has no value at a time of others.
// Changes the columns of the plan; a plan without channels stays as it is.
LogTable side_by_side(LogTable table, LogPlan& plan);

}  // namespace ballbar

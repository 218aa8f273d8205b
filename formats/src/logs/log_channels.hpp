// Channels below each other: each row has the name of a channel, its time and its value.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "logs/column_sample.hpp"
#include "logs/log_plan.hpp"
#include "logs/log_table.hpp"

namespace ballbar {

// Marks the first column whose words come back, which may be names of channels (ColumnKind::channel), and takes the
// units of channels from another column of words.
void find_channel_names(const LogShape& shape, const std::vector<ColumnSample>& samples, LogPlan& plan);

// Where the rows are those of channels: a column for each channel, and a row for each time. A channel has a gap where
// it has no value at a time of others. The plan gets these columns.
//
// Rows are of channels if the time rises within each of them but not from row to row; or, where it rises from row to
// row too, if the values go on from those of the same channel and jump from one channel to another. Throws Error with
// name:line where they may be of one table as well.
LogTable side_by_side(LogTable table, const std::string& name, LogPlan& plan);

}  // namespace ballbar

// What looks wrong with a column, in words and in JSON.
#pragma once

#include <string>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/message.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// "8 readings lie far off their neighbours, the first, 305, at 2 h 12 min"
std::string what_text(const ColumnFault& fault);

// "probe_Z_um: 8 readings lie far off ..."
std::string fault_text(const ColumnFault& fault);

// A wrapped line each; empty where there are none.
std::string lines_of(const std::vector<ColumnFault>& faults);

// "bed_degC jumps by 1.5 degC at 4 h 47 min ..."
Message sentence_of(const SensorJump& jump);

template <>
inline constexpr auto kResult<ColumnFault> =
    ResultType("ColumnFault", "What looks wrong with a column.",
               Field{"column", &ColumnFault::column, "empty: the time"}, Field{"what", &what_text},
               Field{"kind", &ColumnFault::kind, "pauses, few_values, gaps, constant, stuck, far_off, clipped, jumps"},
               Field{"count", &ColumnFault::count, "pauses, rows or jumps"},
               Field{"value", &ColumnFault::value,
                     "at which it stands; far_off: the first; jumps: their median size; pauses: the longest, in s; "
                     "gaps: their share"},
               Field{"at_s", &ColumnFault::at_s, "of the first; pauses: of the longest"});

}  // namespace ballbar

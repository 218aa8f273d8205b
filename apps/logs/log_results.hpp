// What `import --json` prints, of one log and of several.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/formats/logs/log.hpp"
#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/internal/series/clock_lag.hpp"
#include "ballbar/internal/series/zone_shift.hpp"
#include "model/column_fault_text.hpp"

namespace ballbar {

// Of a column that the series has.
inline bool is_left_out(const LogColumn& of) { return of.name.empty(); }
inline bool is_taken(const LogColumn& of) { return !is_left_out(of); }
constexpr auto if_taken(auto get) { return where(&is_taken, get); }

template <>
inline constexpr auto kResult<LogColumn> = ResultType(
    "LogColumn", "A column of a log, and its interpretation.",
    Field{"source", &LogColumn::source, "its header in the log"},
    Field{"found_unit", may_lack(&LogColumn::found_unit), "as the log writes it"},
    Field{"left_out", where(&is_left_out, &LogColumn::why), "why it is not in the series; then nothing else is there"},
    Field{"name", if_taken(&LogColumn::name), "in the series"}, Field{"unit", if_taken(&LogColumn::unit)},
    Field{"role", if_taken(&LogColumn::role)}, Field{"why", if_taken(&LogColumn::why), "what tells the role"},
    Field{"gaps", if_taken(&LogColumn::gaps), "cells without a value"},
    Field{"first", if_taken(&LogColumn::first), "its first values, at most five"});

inline std::vector<double> first_times_s(const Log& log) {
  const std::span<const double> all = log.series.time_s, first = all.first(std::min(kShownRows, all.size()));
  return {first.begin(), first.end()};
}

inline std::vector<std::string> targets_of(const Log& log) {
  std::vector<std::string> names;
  for (const LogColumn& column : log.columns) {
    if (!column.name.empty() && column.role == Role::measured) names.push_back(column.name);
  }
  return names;
}

struct ImportedLog {
  std::string file;
  Log log;
  std::vector<ColumnFault> faults;
};

constexpr auto of_log(auto... get) { return in(&ImportedLog::log, get...); }

template <>
inline constexpr auto kResult<ImportedLog> = ResultType(
    "Imported", "The interpretation of a log.", Field{"file", &ImportedLog::file},
    Field{"shape", of_log(&Log::shape), "how the values stand"}, Field{"time", of_log(&Log::time), "where the time is"},
    Field{"started", may_lack(of_log(&Log::series, &Series::started)), "wall clock of time 0"},
    Field{"rows", count(of_log(&Log::series, &Series::time_s)), "how many"},
    Field{"first_row_line", of_log(&Log::first_row_line)},
    Field{"clock", of_log(&Log::series, &Series::has_clock), "false: the rows are numbered"},
    Field{"first_times_s", of_log(&first_times_s), "of the first rows, at most five"},
    Field{"sheet", may_lack(of_log(&Log::recipe, &LogRecipe::sheet)), "of the workbook"},
    Field{"sheets", may_lack(of_log(&Log::sheets)), "of the workbook, all"},
    Field{"columns", of_log(&Log::columns), "of the log, that of the time left out"},
    Field{"targets", of_log(&targets_of), "columns that are measured"},
    Field{"unclear", of_log(&Log::unclear), "what a user should state"},
    Field{"skipped_lines", of_log(&Log::skipped_lines), "numbers of the lines that are no rows of numbers"},
    Field{"remarks", of_log(&Log::remarks), "what looks broken, what was mended, what was assumed"},
    Field{"faults", &ImportedLog::faults, "of columns"});

struct MergedPart {
  std::string file;
  double moved_s = 0.0;  // what was added to its own times
  std::optional<double> by_date_s;
  std::optional<ClockLag> lag;
  std::optional<ZoneShift> zone;  // proposed, not applied
};

template <class Shift>
std::vector<std::string> both_columns(const Shift& of) {
  return {of.column, of.other};
}
constexpr auto of_lag(auto get) { return may_lack(in(&MergedPart::lag, get)); }
constexpr auto of_zone(auto get) { return may_lack(in(&MergedPart::zone, get)); }

template <>
inline constexpr auto kResult<MergedPart> =
    ResultType("MergedPart", "A log, and how its clock was set.", Field{"file", &MergedPart::file},
               Field{"moved_s", &MergedPart::moved_s, "what was added to its times"},
               Field{"by_date_s", may_lack(&MergedPart::by_date_s), "by the dates alone"},
               Field{"lag_s", of_lag(&ClockLag::lag_s), "by what both logs show"},
               Field{"lag_sigma_s", of_lag(&ClockLag::sigma_s)}, Field{"correlation", of_lag(&ClockLag::correlation)},
               Field{"compared", of_lag(&both_columns<ClockLag>), "columns of the first log and of this one"},
               Field{"proposed_shift_s", of_zone(&ZoneShift::shift_s),
                     "by which --shift may set it, because two temperatures change together then"},
               Field{"shift_correlation", of_zone(&ZoneShift::correlation), "of their changes with that shift"},
               Field{"shift_compared", of_zone(&both_columns<ZoneShift>), "columns of the first log and of this one"});

struct MergedSeries {
  Series series;
  std::vector<MergedPart> parts;  // a log each
};

template <>
inline constexpr auto kResult<MergedSeries> = ResultType(
    "Merged", "Logs made one series.", Field{"rows", count(in(&MergedSeries::series, &Series::time_s)), "how many"},
    Field{"columns", count(in(&MergedSeries::series, &Series::columns)), "how many"},
    Field{"parts", &MergedSeries::parts, "the logs"});

}  // namespace ballbar

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

// Of a column that the series has, or of one that it has not.
template <class Type>
constexpr auto if_taken(Type LogColumn::*member, bool taken = true) {
  return [member, taken](const LogColumn& of) {
    return MayLack<Type>{of.name.empty() == taken ? std::nullopt : std::optional(of.*member)};
  };
}

template <class Value>
MayLack<Value> if_any(const Value& value) {
  return {value.empty() ? std::nullopt : std::optional(value)};
}

template <>
inline constexpr auto kResult<LogColumn> = ResultType{
    "LogColumn", "A column of a log, and its interpretation.",
    std::tuple{
        Field{"source", &LogColumn::source, "its header in the log"},
        Field{"found_unit", [](const LogColumn& of) { return if_any(of.found_unit); }, "as the log writes it"},
        Field{"left_out", if_taken(&LogColumn::why, false), "why it is not in the series; then nothing else is there"},
        Field{"name", if_taken(&LogColumn::name), "in the series"}, Field{"unit", if_taken(&LogColumn::unit), ""},
        Field{"role", if_taken(&LogColumn::role), ""}, Field{"why", if_taken(&LogColumn::why), "what tells the role"},
        Field{"gaps", if_taken(&LogColumn::gaps), "cells without a value"},
        Field{"first", if_taken(&LogColumn::first), "its first values, at most five"}}};

inline std::vector<double> first_times_s(const Log& log) {
  const std::span<const double> all = log.series.time_s, first = all.first(std::min(kShownRows, all.size()));
  return {first.begin(), first.end()};
}

inline std::vector<std::string> targets(const Log& log) {
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

template <>
inline constexpr auto kResult<ImportedLog> = ResultType{
    "Imported", "The interpretation of a log.",
    std::tuple{
        Field{"file", &ImportedLog::file, ""},
        Field{"shape", [](const ImportedLog& of) { return of.log.shape; }, "how the values stand"},
        Field{"time", [](const ImportedLog& of) { return of.log.time; }, "where the time is"},
        Field{"started", [](const ImportedLog& of) { return MayLack<std::string>{of.log.series.started}; },
              "wall clock of time 0"},
        Field{"rows", [](const ImportedLog& of) { return of.log.series.time_s.size(); }, "how many"},
        Field{"first_row_line", [](const ImportedLog& of) { return of.log.first_row_line; }, ""},
        Field{"clock", [](const ImportedLog& of) { return of.log.series.has_clock; }, "false: the rows are numbered"},
        Field{"first_times_s", [](const ImportedLog& of) { return first_times_s(of.log); },
              "of the first rows, at most five"},
        Field{"sheet", [](const ImportedLog& of) { return if_any(of.log.recipe.sheet); }, "of the workbook"},
        Field{"sheets", [](const ImportedLog& of) { return if_any(of.log.sheets); }, "of the workbook, all"},
        Field{"columns", [](const ImportedLog& of) { return of.log.columns; }, "of the log, that of the time left out"},
        Field{"targets", [](const ImportedLog& of) { return targets(of.log); }, "columns that are measured"},
        Field{"unclear", [](const ImportedLog& of) { return of.log.unclear; }, "what a user should state"},
        Field{"skipped_lines", [](const ImportedLog& of) { return of.log.skipped_lines; },
              "numbers of the lines that are no rows of numbers"},
        Field{"remarks", [](const ImportedLog& of) { return of.log.remarks; },
              "what looks broken, what was mended, what was assumed"},
        Field{"faults", &ImportedLog::faults, "of columns"}}};

struct MergedPart {
  std::string file;
  double moved_s = 0.0;  // what was added to its own times
  std::optional<double> by_date_s;
  std::optional<ClockLag> lag;
  std::optional<ZoneShift> zone;  // proposed, not applied
};

constexpr auto of_zone(double ZoneShift::*member) {
  return [member](const MergedPart& of) {
    return MayLack<double>{of.zone ? std::optional((*of.zone).*member) : std::nullopt};
  };
}

constexpr auto of_lag(double ClockLag::*member) {
  return [member](const MergedPart& of) {
    return MayLack<double>{of.lag ? std::optional((*of.lag).*member) : std::nullopt};
  };
}

template <>
inline constexpr auto kResult<MergedPart> = ResultType{
    "MergedPart", "A log, and how its clock was set.",
    std::tuple{
        Field{"file", &MergedPart::file, ""}, Field{"moved_s", &MergedPart::moved_s, "what was added to its times"},
        Field{"by_date_s", [](const MergedPart& of) { return MayLack<double>{of.by_date_s}; }, "by the dates alone"},
        Field{"lag_s", of_lag(&ClockLag::lag_s), "by what both logs show"},
        Field{"lag_sigma_s", of_lag(&ClockLag::sigma_s), ""}, Field{"correlation", of_lag(&ClockLag::correlation), ""},
        Field{"compared",
              [](const MergedPart& of) {
                return MayLack<std::vector<std::string>>{
                    of.lag ? std::optional(std::vector{of.lag->column, of.lag->other}) : std::nullopt};
              },
              "columns of the first log and of this one"},
        Field{"proposed_shift_s", of_zone(&ZoneShift::shift_s),
              "by which --shift may set it, because two temperatures change together then"},
        Field{"shift_correlation", of_zone(&ZoneShift::correlation), "of their changes with that shift"},
        Field{"shift_compared",
              [](const MergedPart& of) {
                return MayLack<std::vector<std::string>>{
                    of.zone ? std::optional(std::vector{of.zone->column, of.zone->other}) : std::nullopt};
              },
              "columns of the first log and of this one"}}};

struct MergedSeries {
  Series series;
  std::vector<MergedPart> parts;  // a log each
};

template <>
inline constexpr auto kResult<MergedSeries> =
    ResultType{"Merged", "Logs made one series.",
               std::tuple{Field{"rows", [](const MergedSeries& of) { return of.series.time_s.size(); }, "how many"},
                          Field{"columns", [](const MergedSeries& of) { return of.series.columns.size(); }, "how many"},
                          Field{"parts", &MergedSeries::parts, "the logs"}}};

}  // namespace ballbar

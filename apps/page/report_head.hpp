// The head of a page's data: what every page has.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/results/message.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct PageColumn {
  std::string name;
  Role role = Role::event;
  std::string unit;
  Bulk values;
};

template <>
inline constexpr auto kResult<PageColumn> =
    ResultType("Column", "A column on the clock of its series.", Field{"name", &PageColumn::name, "with its unit"},
               Field{"role", &PageColumn::role, "as in a series file: structure, ambient, speed, measured, ..."},
               Field{"unit", &PageColumn::unit}, Field{"values", &PageColumn::values});

struct SignalsPart {
  std::string source;
  Bulk time_s;
  std::vector<PageColumn> columns;
  std::optional<std::size_t> rows;
  std::optional<std::string> started;
};

template <>
inline constexpr auto kResult<SignalsPart> =
    ResultType("SeriesBlock", "Columns on one clock.", Field{"source", &SignalsPart::source, "the file"},
               Field{"time_s", known(&SignalsPart::time_s)}, Field{"columns", &SignalsPart::columns},
               Field{"rows", may_lack(&SignalsPart::rows), "of the file, where not all are here"},
               Field{"started", may_lack(&SignalsPart::started), "wall clock of time 0, where it is known"});

struct ReportHead {
  std::string format;
  Paragraph title;
  std::string made_by, made_on;
  std::vector<std::string> files;
  std::vector<Paragraph> summary;
  std::vector<SignalsPart> signals;
};
// Of today and of this program, without files yet.
ReportHead report_head(const std::string& title);

template <>
inline constexpr auto kResult<ReportHead> = ResultType(
    "ReportHead", "What every page has.", Field{"format", &ReportHead::format, "ballbar-report 1"},
    Field{"title", &ReportHead::title}, Field{"made_by", &ReportHead::made_by, "the program with its version"},
    Field{"made_on", &ReportHead::made_on, "date"}, Field{"files", &ReportHead::files, "that it is made of"},
    Field{"summary", &ReportHead::summary, "the conclusions, whole sentences, first to be read"},
    Field{"signals", &ReportHead::signals, "temperatures, speed and the like, each file on its own clock"});

}  // namespace ballbar

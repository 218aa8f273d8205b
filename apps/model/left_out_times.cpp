#include "model/left_out_times.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/series/runs.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

// "3840", "3840s", "64min", "1.5h"
std::optional<double> time_s(std::string_view text) {
  const std::size_t end = text.find_first_not_of("0123456789.+-");
  const std::map<std::string_view, double> units{{"", 1.0}, {"s", 1.0}, {"min", 60.0}, {"h", 3600.0}};
  const auto unit = units.find(end == std::string_view::npos ? "" : text.substr(end));
  const std::optional<double> number = finite_number(text.substr(0, end));
  if (unit == units.end() || !number) return std::nullopt;
  return *number * unit->second;
}

std::optional<TimeRange> range_of(const std::string& text) {
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) return std::nullopt;
  const auto from = time_s(std::string_view(text).substr(0, dots)),
             to = time_s(std::string_view(text).substr(dots + 2));
  if (!from || !to || *from > *to) return std::nullopt;
  return TimeRange{*from, *to};
}

}  // namespace

std::string text_of(const TimeRange& range) { return fmt::format("{:g} s to {:g} s", range.from_s, range.to_s); }

void add_left_out_times(CLI::App& command, std::vector<TimeRange>& left_out) {
  const auto take = [&left_out](const std::string& text) {
    const std::optional<TimeRange> range = range_of(text);
    if (!range) {
      throw CLI::ValidationError("--leave-out-times",
                                 fmt::format("expected FROM..TO, such as 2h..3.5h, found {}", in_quotes(text)));
    }
    left_out.push_back(*range);
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--leave-out-times",
          [take](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) take(text);
          },
          "readings between two times that are not to be explained, such as 2h..3.5h; may be repeated")
      ->type_name("FROM..TO")
      ->allow_extra_args(false);
}

std::shared_ptr<const ModelData> without_times(std::shared_ptr<const ModelData> data,
                                               const std::vector<TimeRange>& left_out) {
  if (left_out.empty()) return data;
  if (data->level == Level::recording)
    throw Error("--leave-out-times: expected a drift series, whose readings have a time, found recordings.");
  auto series = std::make_shared<Series>(*data->series);
  const std::vector<double> time_s = one_after_another(series->time_s);
  for (const TimeRange& range : left_out) {
    bool any = false;
    for (Column& column : series->columns) {
      if (!is_target(column)) continue;
      for (std::size_t row = 0; row < time_s.size(); ++row) {
        if (time_s[row] < range.from_s || time_s[row] > range.to_s || std::isnan(column.values[row])) continue;
        column.values[row] = std::numeric_limits<double>::quiet_NaN();
        any = true;
      }
    }
    if (!any) {
      throw Error(
          fmt::format("--leave-out-times: expected a time in which something was measured, found {}.", text_of(range)));
    }
  }
  auto rest = std::make_shared<ModelData>(*data);
  rest->series = std::move(series);
  return rest;
}

}  // namespace ballbar

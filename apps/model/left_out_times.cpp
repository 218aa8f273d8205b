#include "model/left_out_times.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/series/series.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

std::optional<TimeRange> range_of(const std::string& text) {
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) return std::nullopt;
  const auto from = time_s_of(text.substr(0, dots)), to = time_s_of(text.substr(dots + 2));
  if (!from || !to || *from > *to) return std::nullopt;
  return TimeRange{*from, *to};
}

}  // namespace

std::string text_of(const TimeRange& range) { return fmt::format("{:g} s to {:g} s", range.from_s, range.to_s); }

void add_left_out_times(CLI::App& command, std::vector<TimeRange>& left_out) {
  const auto take = [&left_out](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const std::optional<TimeRange> range = range_of(text);
      if (!range) {
        throw CLI::ValidationError("--leave-out-times",
                                   fmt::format("expected FROM..TO, such as 2h..3.5h, found {}", in_quotes(text)));
      }
      left_out.push_back(*range);
    }
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--leave-out-times", take, "omit readings between two times, such as 2h..3.5h; may be repeated")
      ->type_name("FROM..TO")
      ->allow_extra_args(false);
}

ModelData without_times(ModelData data, const std::vector<TimeRange>& left_out) {
  if (left_out.empty()) return data;
  if (data.level == Level::recording)
    throw Error("--leave-out-times: expected a drift series, whose readings have a time, found recordings.");
  auto series = std::make_shared<Series>(*data.series);
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
  data.series = std::move(series);
  return data;
}

}  // namespace ballbar

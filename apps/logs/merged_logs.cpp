#include "logs/merged_logs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "ballbar/error.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/series/series.hpp"
#include "model/model_options.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

struct Part {
  MergedPart merged;
  Series series;
  double stated_shift_s = 0.0;
};

Part opened(const Source& log) {
  Part part{{log.name(), 0.0, std::nullopt, std::nullopt}, {}};
  OpenedSeries opened = opened_series(log);
  tell(opened.remarks);
  part.stated_shift_s = stated_shift_s(log.recipe(), log.name());
  part.series = *opened.series;
  return part;
}

// By the dates of both, then by what both know.
void align(const Part& first, Part& part, const ClockOptions& options) {
  const auto a = first.series.started ? seconds_of_stamp(*first.series.started) : std::nullopt;
  const auto b = part.series.started ? seconds_of_stamp(*part.series.started) : std::nullopt;
  if (a && b) part.merged.by_date_s = *b - *a;
  part.merged.moved_s = part.merged.by_date_s.value_or(0.0);
  for (double& time : part.series.time_s) time += part.merged.moved_s;
  if (options.keep_clocks) return;
  if (part.merged.by_date_s) part.merged.zone = zone_shift(first.series, part.series);
  if (part.merged.zone) part.merged.zone->shift_s += part.stated_shift_s;
  const double span_s = std::max(first.series.time_s.back() - first.series.time_s.front(),
                                 part.series.time_s.back() - part.series.time_s.front());
  // Two clocks with dates differ by minutes, two without by as much as the logs are long.
  const double range_s =
      options.range_s.value_or(part.merged.by_date_s ? std::min(1800.0, 0.25 * span_s) : 0.5 * span_s);
  part.merged.lag = clock_lag(first.series, part.series, range_s);
  if (!part.merged.lag || std::abs(part.merged.lag->lag_s) <= part.merged.lag->sigma_s) return;
  part.merged.moved_s += part.merged.lag->lag_s;
  for (double& time : part.series.time_s) time += part.merged.lag->lag_s;
}

std::string clock_text(const MergedPart& first, const MergedPart& part, bool keep_clocks) {
  std::string text = part.by_date_s
                         ? fmt::format("starts {} {} by the dates of both", duration_text(std::abs(*part.by_date_s)),
                                       *part.by_date_s < 0.0 ? "earlier" : "later")
                         : std::string("has no date in common with the first, so both are taken to start together");
  if (part.lag && std::abs(part.lag->lag_s) <= part.lag->sigma_s) {
    text += fmt::format("; its clock agrees within {:.2f} s, as {} and {} show (correlation {:.3f})", part.lag->sigma_s,
                        part.lag->column, part.lag->other, part.lag->correlation);
  } else if (part.lag) {
    text += fmt::format("; its clock is {} by {}, as {} and {} show (correlation {:.3f}), and was corrected",
                        part.lag->lag_s > 0.0 ? "behind" : "ahead",
                        fmt::format("{:.2f} ± {:.2f} s", std::abs(part.lag->lag_s), part.lag->sigma_s),
                        part.lag->column, part.lag->other, part.lag->correlation);
  } else if (!keep_clocks) {
    text +=
        fmt::format("; no signal that it shares with {} shows a clock error, so its clock is unchanged", first.file);
  }
  return text + ".";
}

// "" where the curves say nothing.
std::string zone_text(const MergedPart& part) {
  if (!part.zone) return {};
  const ZoneShift& zone = *part.zone;
  const bool is_h = std::fmod(zone.shift_s, 3600.0) == 0.0;
  return fmt::format(
      "{} may be of another time zone: set {} {}, {} and {} change together (correlation of their changes {:.2f}, now "
      "{:.2f}). If so, state --shift {}={:g}{}.",
      part.file, duration_text(std::abs(zone.shift_s)), zone.shift_s > 0.0 ? "later" : "earlier", zone.column,
      zone.other, zone.correlation, zone.correlation_now,
      shell_word(std::filesystem::path(part.file).filename().string()), zone.shift_s / (is_h ? 3600.0 : 60.0),
      is_h ? "h" : "min");
}

}  // namespace

MergedSeries merged_series(const std::vector<Source>& logs, const ClockOptions& clocks) {
  expect_once(logs);
  std::vector<Part> parts;
  std::set<std::string> taken;
  for (const Source& log : logs) {
    parts.push_back(opened(log));
    if (parts.size() > 1) align(parts.front(), parts.back(), clocks);
    for (Column& column : parts.back().series.columns) column.name = free_name(column.name, taken);
  }
  const auto started = parts.front().series.started ? seconds_of_stamp(*parts.front().series.started) : std::nullopt;
  MergedSeries result;
  std::vector<Series> all;
  all.reserve(parts.size());
  for (Part& part : parts) {
    all.push_back(std::move(part.series));
    result.parts.push_back(std::move(part.merged));
  }
  try {
    result.series = merged(all, clocks.max_gap_s);
  } catch (const Error& error) {
    std::string why = error.what();
    for (const MergedPart& part : result.parts) {
      if (const std::string text = zone_text(part); !text.empty()) why += " " + text;
    }
    throw Error(why);
  }
  if (!started) return result;
  const double first_s = result.series.time_s.front();
  result.series.started = stamp_text(*started + first_s);
  for (double& time : result.series.time_s) time -= first_s;
  return result;
}

void print_text(const MergedSeries& merged, const ClockOptions& clocks) {
  const std::vector<double>& time_s = merged.series.time_s;
  fmt::print("{} rows over {}, {} columns of {} logs\n\n", time_s.size(), duration_text(time_s.back() - time_s.front()),
             merged.series.columns.size(), merged.parts.size());
  for (std::size_t i = 1; i < merged.parts.size(); ++i) {
    fmt::print("{}", wrapped(fmt::format("{}: {}", merged.parts[i].file,
                                         clock_text(merged.parts.front(), merged.parts[i], clocks.keep_clocks))));
    if (const std::string zone = zone_text(merged.parts[i]); !zone.empty()) fmt::print("{}", wrapped(zone));
  }
}

}  // namespace ballbar

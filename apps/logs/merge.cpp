// `ballbar merge LOG LOG... --out clean.csv`: several logs, each with its own clock, as one series.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <set>

#include "ballbar/error.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/number_text.hpp"
#include "ballbar/series/merged_series.hpp"
#include "commands.hpp"
#include "logs/log_options.hpp"
#include "logs/log_results.hpp"
#include "model/model_options.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

struct MergeArguments {
  std::vector<std::string> logs;
  std::string out;
  std::optional<double> max_gap_s, range_s;
  bool keep_clocks = false, json = false;
  LogOptions how;
};

struct Part {
  MergedPart merged;
  Series series;
};

Part opened(const std::string& file, const LogOptions& how) {
  Part part{{file, 0.0, std::nullopt, std::nullopt}, {}};
  OpenedSeries opened = opened_series(file, known_readers(), recipe_of(how));
  tell(opened.remarks);
  part.series = *opened.series;
  return part;
}

// By the dates of both, then by what both know.
void align(const Part& first, Part& part, const MergeArguments& options) {
  const auto a = first.series.started ? seconds_of_stamp(*first.series.started) : std::nullopt;
  const auto b = part.series.started ? seconds_of_stamp(*part.series.started) : std::nullopt;
  if (a && b) part.merged.by_date_s = *b - *a;
  part.merged.moved_s = part.merged.by_date_s.value_or(0.0);
  for (double& time : part.series.time_s) time += part.merged.moved_s;
  if (options.keep_clocks) return;
  const double span_s = std::max(first.series.time_s.back() - first.series.time_s.front(),
                                 part.series.time_s.back() - part.series.time_s.front());
  // Two clocks with dates differ by minutes, two without by as much as the logs are long.
  const double range_s =
      options.range_s.value_or(part.merged.by_date_s ? std::min(1800.0, 0.25 * span_s) : 0.5 * span_s);
  part.merged.lag = clock_lag(first.series, part.series, range_s);
  if (!part.merged.lag) return;
  part.merged.moved_s += part.merged.lag->lag_s;
  for (double& time : part.series.time_s) time += part.merged.lag->lag_s;
}

// A name that an earlier part has gets a number before its unit.
void expect_own_names(Series& series, std::set<std::string>& taken) {
  for (Column& column : series.columns) {
    const std::string unit(unit_of(column.name));
    const std::string stem = unit.empty() ? column.name : column.name.substr(0, column.name.size() - unit.size() - 1);
    for (int k = 2; !taken.insert(column.name).second; ++k)
      column.name = fmt::format("{}_{}{}{}", stem, k, unit.empty() ? "" : "_", unit);
  }
}

std::string clock_text(const Part& first, const Part& part, bool keep_clocks) {
  std::string text = part.merged.by_date_s ? fmt::format("starts {} {} by the dates of both",
                                                         duration_text(std::abs(*part.merged.by_date_s)),
                                                         *part.merged.by_date_s < 0.0 ? "earlier" : "later")
                                           : std::string("has no date beside that of the first: both start together");
  if (part.merged.lag) {
    text += fmt::format("; its clock is {} by {}, as {} and {} show (correlation {:.3f}), and was set right",
                        part.merged.lag->lag_s > 0.0 ? "behind" : "ahead",
                        fmt::format("{:.2f} ± {:.2f} s", std::abs(part.merged.lag->lag_s), part.merged.lag->sigma_s),
                        part.merged.lag->column, part.merged.lag->other, part.merged.lag->correlation);
  } else if (!keep_clocks) {
    text += fmt::format("; nothing that {} and it both know tells the clocks apart: they were left as they are",
                        first.merged.file);
  }
  return text + ".";
}

void run(const MergeArguments& options) {
  expect_no_input({options.out}, {options.logs.begin(), options.logs.end()});
  std::vector<Part> parts;
  std::set<std::string> taken;
  for (const std::string& file : options.logs) {
    for (const Part& before : parts) {
      std::error_code absent;
      if (!std::filesystem::equivalent(before.merged.file, file, absent)) continue;
      throw Error(fmt::format("{}: expected each log once, found it again.", file));
    }
    parts.push_back(opened(file, options.how));
    if (parts.size() > 1) align(parts.front(), parts.back(), options);
    expect_own_names(parts.back().series, taken);
  }
  std::vector<Series> all;
  all.reserve(parts.size());
  for (const Part& part : parts) all.push_back(part.series);
  Series series = merged(all, options.max_gap_s.value_or(kUsualGap_s));
  const double first_s = series.time_s.front();
  if (const auto started =
          parts.front().series.started ? seconds_of_stamp(*parts.front().series.started) : std::nullopt) {
    series.started = stamp_of_seconds(*started + first_s);
    for (double& time : series.time_s) time -= first_s;
  }
  if (!options.out.empty())
    write_through(options.out,
                  [&](const std::filesystem::path& path) { write_series_parts(series, series_header(series), path); });
  if (options.json) {
    MergedLogs result{series.time_s.size(), series.columns.size(), {}};
    for (const Part& part : parts) result.parts.push_back(part.merged);
    print_json(json_of(result));
    return;
  }
  fmt::print("{} rows over {}, {} columns of {} logs\n\n", series.time_s.size(),
             duration_text(series.time_s.back() - series.time_s.front()), series.columns.size(), parts.size());
  for (std::size_t i = 1; i < parts.size(); ++i)
    fmt::print("{}", wrapped(fmt::format("{}: {}", parts[i].merged.file,
                                         clock_text(parts.front(), parts[i], options.keep_clocks))));
  fmt::print("\n{}\n",
             options.out.empty() ? "Nothing was written; --out clean.csv writes the series." : "wrote " + options.out);
}

}  // namespace

void add_merge(CLI::App& app) {
  const auto options = std::make_shared<MergeArguments>();
  CLI::App* command = app.add_subcommand("merge", "Several logs, each with its own clock, as one series");
  command->add_option("LOG", options->logs, "logs as import reads them, and series; the clock of the first counts")
      ->required()
      ->expected(2, 1000);
  command->add_option("--out", options->out, "series .csv to write")->type_name("FILE");
  command->add_flag("--keep-clocks", options->keep_clocks, "by their dates alone, without a lag from what both know");
  take_time(*command->add_option("--lag-range", options->range_s,
                                 "how far apart the clocks may be; default: 30min, without dates half the log"),
            true);
  add_max_gap(*command, options->max_gap_s);
  command->add_flag("--json", options->json, "print what was done as JSON");
  add_log_options(*command, options->how);
  command->footer(
      "Example:\n"
      "  ballbar merge sample-runs/foreign-logs/probes.csv sample-runs/foreign-logs/control.csv --out clean.csv");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands

// `ballbar import LOG... --out clean.csv`: shows how a log is interpreted and writes it as a series; several logs
// become one.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/recipe_toml.hpp"
#include "ballbar/formats/recordings/ballbar_log.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/internal/number_text.hpp"
#include "commands.hpp"
#include "logs/log_results.hpp"
#include "logs/merged_logs.hpp"
#include "model/model_options.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/log_options.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

// A circle, written as a ballbar log; what a table of angles or coordinates does not state.
struct CircleOptions {
  bool circle = false;
  StatedCircle stated;
  std::optional<Plane> plane;
  Motion motion = Motion::linear_axes;
};

struct ImportArguments {
  std::vector<Source> logs;
  std::vector<std::string> targets;
  CircleOptions circle;
  std::string out, save;
  ClockOptions clocks;
  std::vector<std::string> shifts;  // LOG=TIME
  bool details = false;
  bool json = false;
};

std::string shown(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string("-"); }

// A row a column: its header, name and role, and the first rows as understood.
std::string columns_text(const Log& log, bool details) {
  const Series& series = log.series;
  const std::size_t rows = std::min(kShownRows, series.time_s.size());
  std::vector<std::string> heading{"log column", "unit", "series column", "role"};
  for (std::size_t row = 0; row < rows; ++row) {
    heading.push_back(series.has_clock ? fmt::format("{:.6g} s", series.time_s[row]) : fmt::format("row {}", row + 1));
  }
  heading.emplace_back("gaps");
  Table table(heading);
  std::size_t k = 0;
  for (const LogColumn& column : log.columns) {
    std::vector<std::string> cells{shortened(column.source, 40),
                                   column.found_unit.empty() ? "-" : shortened(column.found_unit, 12)};
    if (column.name.empty()) {
      cells.insert(cells.end(), {"-", "left out: " + column.why});
      cells.resize(heading.size(), "");
    } else {
      cells.insert(cells.end(), {column.name, std::string(name_of(column.role))});
      for (std::size_t row = 0; row < rows; ++row) cells.push_back(shown(series.columns[k].values[row]));
      cells.push_back(column.gaps == 0 ? "" : fmt::format("{}", column.gaps));
      ++k;
    }
    table.add(cells);
  }
  constexpr std::size_t kColumns = 20;
  if (!details) table.shorten(kColumns);
  return table.text();
}

// The evidence for a role, where the unit does not show it.
std::vector<std::string> guesses(const Log& log) {
  std::vector<std::string> lines;
  for (const LogColumn& column : log.columns) {
    if (column.name.empty() || column.why.empty() || column.why == "by its unit" || column.why == "by its name" ||
        column.why == "by the recipe" || column.why == "by name and values" || column.why.ends_with('?'))
      continue;
    lines.push_back(fmt::format("{}: {}.", column.source, column.why));
  }
  return lines;
}

void print(const ImportArguments& options, const Log& log, const std::vector<ColumnFault>& faults) {
  const std::vector<double>& time_s = log.series.time_s;
  fmt::print("{}\n{}\n", options.logs.front().name(), wrapped(sentence_of(log)));
  if (log.series.has_clock) {
    fmt::print("{} rows over {}{}\n\n", time_s.size(), duration_text(time_s.back() - time_s.front()),
               log.series.started ? fmt::format(", started {}", *log.series.started) : std::string());
  } else {
    fmt::print("{} rows without a time. State their interval, as in --every 10s.\n\n", time_s.size());
  }
  fmt::print("{}", columns_text(log, options.details));
  const auto list = [&](std::string_view title, const std::vector<std::string>& lines) {
    constexpr std::size_t kShown = 4;
    if (lines.empty()) return;
    fmt::print("\n{}\n", title);
    const std::size_t shown = options.details ? lines.size() : std::min(kShown, lines.size());
    for (std::size_t i = 0; i < shown; ++i) fmt::print("{}", wrapped("- " + lines[i]));
    if (shown < lines.size()) fmt::print("{}\n", more_text(lines.size() - shown, "line"));
  };
  list("Guessed:", guesses(log));
  list("Corrected or assumed:", log.remarks);
  list("Please check:", log.unclear);
  std::vector<std::string> broken;
  broken.reserve(faults.size());
  for (const ColumnFault& fault : faults) broken.push_back(fault_text(fault));
  list("Suspicious:", broken);
  if (options.out.empty()) fmt::print("\nNothing was written. Use --out clean.csv to write the series.\n");
}

// A series of our own is no log to be guessed at; it is only shown.
Log opened(const ImportArguments& options) {
  const Reader* const reader = options.logs.front().reader();
  if (read_of<ReadCircle>(reader) != nullptr) {
    stderr_line(
        fmt::format("{}: this table is a circle. Fit it with ballbar fit, or convert it with ballbar import --circle",
                    options.logs.front().name()));
  }
  if (read_of<ReadSeries>(reader) == nullptr) return open_log(options.logs.front());
  Log log;
  log.series = open_series(options.logs.front());
  for (const Column& column : log.series.columns) {
    const std::string unit(unit_of(column.name));
    LogColumn& shown = log.columns.emplace_back(
        LogColumn{column.name, column.name, unit, unit, column.role, false, "by its unit", 0, {}});
    show_values(shown, column.values);
  }
  log.shape = "a ballbar series";
  log.time = "\"time_s\" in s";
  log.first_row_line = 1;
  return log;
}

void run_one(const ImportArguments& options) {
  ImportedLog imported{options.logs.front().name(), opened(options), {}};
  const Log& log = imported.log;
  imported.faults = column_faults(log.series);
  if (!options.out.empty()) write_series(log.series, options.out);
  if (!options.save.empty()) write_bytes(options.save, write_recipe(log.recipe));
  if (options.json) return print_json(json_of(imported));
  print(options, log, imported.faults);
  if (!options.out.empty()) fmt::print("\nwrote {}\n", options.out);
  if (!options.save.empty()) fmt::print("wrote {}\n", options.save);
}

void run_several(const ImportArguments& options) {
  if (!options.save.empty()) throw CLI::ValidationError("--save: expected one log, found several");
  const MergedSeries merged = merged_series(options.logs, options.clocks);
  if (!options.out.empty()) write_series(merged.series, options.out);
  if (options.json) {
    print_json(json_of(merged));
    return;
  }
  print_text(merged, options.clocks);
  fmt::print("\n{}\n", options.out.empty() ? "Nothing was written. Use --out clean.csv to write the series."
                                           : "wrote " + options.out);
}

// The file of a run: that of --out; of several, with its number before the ending.
std::string file_of_run(const std::string& out, std::size_t run, std::size_t runs) {
  if (runs == 1) return out;
  const std::filesystem::path path(out);
  return (path.parent_path() / fmt::format("{}-{}{}", path.stem().string(), run + 1, path.extension().string()))
      .string();
}

void run_circle(const ImportArguments& options) {
  const Source& log = options.logs.front();
  if (options.logs.size() > 1) throw CLI::ValidationError("--circle: expected one file, found several");
  if (!options.save.empty()) throw CLI::ValidationError("--circle: cannot be combined with --save");
  RecordingFile file = open_recording(log, known_readers(), options.circle.stated);
  expect_readings(file, log.path());
  tell(file.remarks);
  const std::size_t runs = file.recordings.size();
  for (std::size_t run = 0; run < runs; ++run) {
    Recording& recording = file.recordings[run];
    recording.motion = options.circle.motion;
    if (options.circle.plane) recording.plane = *options.circle.plane;
    print_for_people(fmt::format("{}: {} {}, driven by {}, {} readings, nominal radius {:g} mm\n", log.name(),
                                 name_of(recording.plane), name_of(recording.direction), name_of(recording.motion),
                                 recording.length_mm.size(), recording.nominal_length_mm));
    if (options.out.empty()) continue;
    const std::string out = file_of_run(options.out, run, runs);
    write_bytes(out, write_ballbar_log(recording));
    wrote_line(out);
  }
  if (options.out.empty()) print_for_people("Nothing was written. Use --out circle.csv to write a ballbar log.\n");
}

// A recipe that is saved may be the one that was read, made more of; the series may be neither.
void expect_own_outputs(const ImportArguments& options) {
  std::vector<std::filesystem::path> inputs = paths_of(options.logs);
  expect_no_input({options.save}, inputs, "--save");
  if (const std::string& recipe = options.logs.front().recipe().file; !recipe.empty()) inputs.emplace_back(recipe);
  for (const std::string& file : options.logs.front().recipe().join) inputs.emplace_back(file);
  expect_no_input({options.out}, inputs);
  const auto place = [](const std::string& file) {
    std::error_code unknown;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file, unknown), unknown);
  };
  if (options.out.empty() || options.save.empty() || place(options.out) != place(options.save)) return;
  throw Error(fmt::format("--out {}: expected another file than that of --save, found the same.", options.out));
}

// What a user calls a target is measured.
void take_targets(ImportArguments& options) {
  if (options.targets.empty()) return;
  for (Source& log : options.logs) {
    auto recipe = std::make_shared<LogRecipe>(log.recipe());
    for (const std::string& target : options.targets)
      recipe->columns.push_back({target, "", "", Role::measured, false});
    log.set_recipe(std::move(recipe));
  }
}

// The clocks of these logs are set later.
void take_shifts(ImportArguments& options) {
  for (const std::string& text : options.shifts) {
    const std::size_t equals = text.rfind('=');
    const auto shift_s = equals == std::string::npos ? std::nullopt : time_s_of(text.substr(equals + 1));
    if (!shift_s) throw CLI::ValidationError("--shift", fmt::format("expected LOG=TIME, found {}", in_quotes(text)));
    const std::string file = text.substr(0, equals);
    bool any = false;
    for (Source& log : options.logs) {
      if (file != log.name() && file != log.path().filename()) continue;
      auto recipe = std::make_shared<LogRecipe>(log.recipe());
      recipe->shifts.push_back({file, *shift_s});
      log.set_recipe(std::move(recipe));
      any = true;
    }
    if (!any) {
      throw CLI::ValidationError("--shift", fmt::format("expected one of the logs, {}, found {}",
                                                        fmt::join(names_of(options.logs), ", "), in_quotes(file)));
    }
  }
}

void run(const ImportArguments& options) {
  expect_own_outputs(options);
  if (options.circle.circle) return run_circle(options);
  if (options.logs.size() > 1) return run_several(options);
  const ClockOptions& clocks = options.clocks;
  if (clocks.keep_clocks || clocks.range_s || clocks.max_gap_s) {
    throw CLI::ValidationError(fmt::format("{}: expected several logs, found one", clocks.keep_clocks ? "--keep-clocks"
                                                                                   : clocks.range_s   ? "--lag-range"
                                                                                                      : "--max-gap"));
  }
  run_one(options);
}

}  // namespace

void add_import(CLI::App& app) {
  const auto options = std::make_shared<ImportArguments>();
  CLI::App* command = app.add_subcommand("import", "Show how a log is interpreted and convert it to a series");
  add_data(*command, "LOG", options->logs,
           "logs of columns over time: text, .xlsx, .mat or .json; several are merged on the clock of the first")
      ->required()
      ->type_name("");
  command->add_option("--out", options->out, "write the series to FILE (.csv)")->type_name("FILE");
  command->add_option("--save", options->save, "write how this log was read to FILE (.toml), for similar logs")
      ->type_name("FILE");
  add_details(*command, options->details);
  command->add_flag("--json", options->json, "print the result as JSON");
  command->add_option("--target", options->targets, "measured column; may be repeated")
      ->type_name("COLUMN")
      ->allow_extra_args(false);
  command->add_flag("--circle", options->circle.circle,
                    "convert a table of angles and lengths, or of coordinates, to a ballbar log");
  add_radius(*command, options->circle.stated);
  add_choice(*command, "--plane", {"XY", "YZ", "ZX"}, "as the file states, else XY",
             "with --circle: plane of the circle", [options](std::size_t at) { options->circle.plane = kPlanes[at]; });
  add_choice(*command, "--motion", {"linear_axes", "rotary_axis", "spindle"}, "linear_axes",
             "with --circle: what drives the circle",
             [options](std::size_t at) { options->circle.motion = static_cast<Motion>(at); });
  command->add_flag("--keep-clocks", options->clocks.keep_clocks, "several logs: align them by their dates alone");
  take_time(
      *command->add_option("--lag-range", options->clocks.range_s,
                           "several logs: largest clock error to search; default: 30min, without dates half the log"),
      true);
  add_max_gap(*command, options->clocks.max_gap_s);
  command
      ->add_option("--shift", options->shifts,
                   "set the clock of a log later, 'room.csv=6h', or earlier, 'room.csv=-1h'; may be repeated")
      ->type_name("LOG=TIME")
      ->allow_extra_args(false);
  command->footer(
      "Examples:\n"
      "  ballbar import sample-runs/foreign-logs/warmup.csv --out clean.csv --save recipe.toml\n"
      "  ballbar import sample-runs/foreign-logs/probes.csv sample-runs/foreign-logs/control.csv --out clean.csv");
  command->callback([options] {
    take_targets(*options);
    take_shifts(*options);
    run(*options);
  });
}

}  // namespace ballbar::commands

#include "ballbar/formats/sessions/data_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <system_error>

#include "ballbar/circle/recording.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/logs/log.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/series/drift_files.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/sessions/runs_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/internal/series/sensor_jumps.hpp"
#include "ballbar/internal/series/sessions.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {
namespace {

// An empty file and one of another kind, told here with all that would do.
void expect_data(const Source& source, std::span<const Reader> readers) {
  if (!source.is_file() || source.is_archive()) return;  // a folder, or nothing: open_drift_data says so
  const Reader* const reader = source.reader(readers);
  if (reads_series(reader) || read_of<ReadSession>(reader) != nullptr) return;
  throw Error(
      fmt::format("{}: expected a log of columns over time (.csv, .xlsx, .mat), a session.toml or recordings (.b5r, "
                  "logs), found {}.",
                  source.name(), found_in(reader)));
}

// Of several units those in um.
std::vector<std::string> measured_names(const Series& series) {
  std::vector<std::string> names;
  for (const Column& column : series.columns) {
    if (is_target(column)) names.push_back(column.name);
  }
  const auto is_in_um = [](const std::string& name) { return unit_of(name) == "um"; };
  if (std::any_of(names.begin(), names.end(), is_in_um)) std::erase_if(names, std::not_fn(is_in_um));
  return names;
}

// The axes of an effect on recordings are those of the plane.
void expect_one_plane(const std::vector<Recording>& recordings, const std::string& last) {
  for (const Recording& recording : recordings) {
    if (recording.plane == recordings.front().plane) continue;
    throw Error(fmt::format("{}: expected recordings of one plane, found {} after {}. Diagnose each plane alone.", last,
                            name_of(recording.plane), name_of(recordings.front().plane)));
  }
}

ModelData data_of_recordings(const std::vector<Source>& sources, std::span<const Reader> readers,
                             const StatedCircle& stated) {
  ModelData data;
  data.level = Level::recording;
  expect_once(sources);
  std::vector<Recording> recordings;
  for (const Source& source : sources) {
    if (!is_recording_file(source, readers)) {
      throw Error(fmt::format("{}: expected a recording as the other files are, a .b5r or a log, found something else.",
                              source.name()));
    }
    RecordingFile file = open_recording(source, readers, stated);
    expect_readings(file, source.path());
    std::move(file.recordings.begin(), file.recordings.end(), std::back_inserter(recordings));
    expect_one_plane(recordings, source.name());
  }
  data.title = sources.size() == 1 ? sources.front().name()
                                   : fmt::format("{} recordings of {} files, {} to {}", recordings.size(),
                                                 sources.size(), sources.front().name(), sources.back().name());
  const bool one = std::all_of(recordings.begin(), recordings.end(),
                               [&](const Recording& r) { return r.motion == recordings.front().motion; });
  if (one && !recordings.empty()) data.motion = recordings.front().motion;
  data.series = std::make_shared<const Series>(trace_of(recordings));
  data.targets = {"deviation_um"};
  data.files = paths_of(sources);
  return data;
}

void say_left_out(std::span<const Series> parts, std::optional<double> max_gap_s, ModelData& data) {
  for (const RowsWithout& without : rows_without_signal(parts, max_gap_s)) {
    const bool in_s = without.max_gap_s < 120.0;
    data.remarks.push_back(
        fmt::format("{}: {} {} left out, because {} has no value there within {:.10g} {}. State a longer --max-gap to "
                    "interpolate.",
                    data.title, without.rows, without.rows == 1 ? "row" : "rows", without.signal,
                    in_s ? without.max_gap_s : std::round(without.max_gap_s / 60.0), in_s ? "s" : "min"));
  }
}

// A series, or a session with its signals.
ModelData data_of_drift(const Source& source, const DriftOptions& options, std::optional<double> max_gap_s,
                        std::span<const Reader> readers) {
  expect_data(source, readers);
  return model_data_of(open_drift_data(source, readers), source.name(), options, max_gap_s, readers);
}

struct ListedRun {
  Source source;
  std::optional<RunStart> start;
};

// A sheet of a workbook, as a log of its own.
Source sheet_of(const Source& workbook, const std::string& sheet) {
  Source source = workbook;
  auto recipe = std::make_shared<LogRecipe>(workbook.recipe());
  recipe->sheet = sheet;
  source.set_recipe(std::move(recipe));
  return source;
}

// The logs of a folder that holds no session and no recordings, by their names. JSON may be anything, and is left out.
std::vector<Source> logs_in(const Source& folder, std::span<const Reader> readers) {
  std::vector<Source> logs;
  std::error_code error;
  if (!folder.is_path() || !std::filesystem::is_directory(folder.path(), error)) return logs;
  std::vector<std::filesystem::path> paths;
  for (std::filesystem::directory_iterator entry(folder.path(), error), end; !error && entry != end;
       entry.increment(error)) {
    paths.push_back(entry->path());
  }
  std::sort(paths.begin(), paths.end());
  for (const std::filesystem::path& path : paths) {
    Source source = folder.like(path);
    if (!source.is_file()) continue;
    const Reader* const reader = source.reader(readers);
    const bool is_json = source.head(1) == "{";
    if (is_recording_file(source, readers) || read_of<ReadSession>(reader) != nullptr) return {};
    source.close();
    if (reads_series(reader) && !is_json) logs.push_back(std::move(source));
  }
  return logs;
}

struct Listing {
  std::vector<ListedRun> runs;
  std::string title;                 // of a list of runs
  std::vector<std::string> remarks;  // whole lines
};

// The sheets of a workbook that are alike, as runs; a log itself.
void add_log(const Source& log, std::span<const Reader> readers, Listing& listing) {
  const bool may_have_sheets =
      !log.is_archive() && read_of<ReadLog>(log.reader(readers)) != nullptr && log.recipe().sheet.empty();
  const WorkbookSheets sheets = may_have_sheets ? sheets_of(log) : WorkbookSheets();
  log.close();  // there may be more than may be open
  if (sheets.alike.size() < 2) {
    listing.runs.push_back({log, std::nullopt});
    return;
  }
  for (const std::string& sheet : sheets.alike) listing.runs.push_back({sheet_of(log, sheet), std::nullopt});
  if (sheets.others.empty()) return;
  listing.remarks.push_back(fmt::format("{}: sheets omitted, because their columns have other names: {}.", log.name(),
                                        fmt::join(sheets.others, ", ")));
}

// A file that lists runs, a workbook of sheets alike and a folder of logs stand for their runs.
Listing listed(const std::vector<Source>& sources, std::span<const Reader> readers) {
  Listing listing;
  for (const Source& source : sources) {
    if (!lists_runs(source, readers)) {
      const std::vector<Source> logs = logs_in(source, readers);
      if (logs.empty()) add_log(source, readers, listing);
      for (const Source& log : logs) add_log(log, readers, listing);
      continue;
    }
    const RunsOfMachine list = read_run_list(source.bytes(kLargestText), source.name());
    if (sources.size() == 1) listing.title = list.title;
    for (const RunOfMachine& run : list.runs) {
      listing.runs.push_back({source.like(source.path().parent_path() / run.file), run.start});
    }
  }
  return listing;
}

// What a remark says besides numbers and the sheet of the run.
std::string without_numbers(std::string text, const std::string& sheet) {
  for (std::size_t at = text.find(sheet); !sheet.empty() && at != std::string::npos; at = text.find(sheet, at))
    text.erase(at, sheet.size());
  std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
  return text;
}

// Of the first run all; of another what was not said of one before, but for numbers. `said`: what was said so.
void add_new_remarks(const ModelData& run, const Source& source, std::set<std::string>& said, ModelData& data) {
  for (const std::string& remark : run.remarks) {
    const std::string what = remark.starts_with(source.title()) ? remark.substr(source.title().size()) : remark;
    if (said.insert(without_numbers(what, source.recipe().sheet)).second) data.remarks.push_back(remark);
  }
}

void expect_one_join(const std::vector<Source>& runs) {
  const auto joins = [](const Source& run) { return !run.recipe().join.empty(); };
  const auto is_other = [&](const Source& run) { return run.name() != runs.front().name(); };
  if (std::none_of(runs.begin(), runs.end(), joins) || std::none_of(runs.begin(), runs.end(), is_other)) return;
  throw Error(fmt::format("{}: expected one log, or the sheets of one workbook, for --join, found several files.",
                          runs.front().name()));
}

void expect_one_clock(const std::vector<Source>& sources, const std::vector<Series>& runs) {
  for (std::size_t k = 1; k < runs.size(); ++k) {
    if (runs[k].has_clock == runs.front().has_clock) continue;
    throw Error(fmt::format("{}: expected {} as in {}, found {}.", sources[k].title(),
                            runs.front().has_clock ? "a time" : "rows without a time", sources.front().title(),
                            runs[k].has_clock ? "a time" : "none"));
  }
}

ModelData data_of_runs(const Listing& listing, const DriftOptions& options, std::optional<double> max_gap_s,
                       std::span<const Reader> readers) {
  std::vector<Source> sources;
  std::vector<std::string> names;
  for (const ListedRun& run : listing.runs) {
    sources.push_back(run.source);
    names.push_back(run.source.title());
  }
  expect_once(sources);
  expect_one_join(sources);
  ModelData data;
  data.remarks = listing.remarks;
  std::vector<Series> runs;
  std::set<std::string> said;
  runs.reserve(sources.size());
  for (const Source& source : sources) {
    ModelData one = data_of_drift(source, options, max_gap_s, readers);
    runs.push_back(*one.series);
    data.files.insert(data.files.end(), one.files.begin(), one.files.end());
    add_new_remarks(one, source, said, data);
  }
  expect_one_clock(sources, runs);
  std::vector<std::optional<double>> zeros_s;
  zeros_s.reserve(runs.size());
  for (const Series& run : runs) zeros_s.push_back(run.started ? seconds_of_stamp(*run.started) : std::nullopt);
  Stacked all = stacked(runs, names, zeros_s);
  for (std::size_t run = 0; run < all.series.runs.size(); ++run) {
    if (listing.runs[run].start) all.series.runs[run].start = *listing.runs[run].start;
  }
  data.series = std::make_shared<const Series>(std::move(all.series));
  data.remarks.insert(data.remarks.end(), all.remarks.begin(), all.remarks.end());
  data.title = fmt::format("{} runs, {}", sources.size(),
                           listing.title.empty() ? fmt::format("{}", fmt::join(names, ", ")) : listing.title);
  data.targets = measured_names(*data.series);
  return data;
}

// The drift of a session, and its signals.
std::vector<Series> parts_of(const SessionFiles& session, const DriftOptions& options, std::span<const Reader> readers,
                             std::vector<std::string>& remarks) {
  std::vector<Series> parts{series_of(drift_of(session.session, options))};
  for (const Source& signals : session.signals) {
    OpenedSeries opened = opened_series(signals, readers);
    parts.push_back(*opened.series);
    remarks.insert(remarks.end(), opened.remarks.begin(), opened.remarks.end());
  }
  return parts;
}

}  // namespace

std::optional<SignalGap> longest_gap(const DriftData& source, std::optional<double> max_gap_s,
                                     std::span<const Reader> readers) {
  if (source.series) return longest_gap(std::span<const Series>(source.series.get(), 1), max_gap_s);
  std::vector<std::string> remarks;
  return longest_gap(parts_of(*source.session, {}, readers, remarks), max_gap_s);
}

ModelData model_data_of(const DriftData& source, const std::string& name, const DriftOptions& options,
                        std::optional<double> max_gap_s, std::span<const Reader> readers) {
  ModelData data;
  data.title = name;
  data.files = source.files;
  data.remarks = source.remarks;
  std::vector<Series> parts;
  if (source.session) {
    if (!source.session->session.title.empty()) data.title = source.session->session.title;
    for (const SkippedFile& one : source.session->skipped) data.remarks.push_back("left out: " + one.why);
    parts = parts_of(*source.session, options, readers, data.remarks);
  }
  try {
    if (parts.size() > 1) {
      data.series = std::make_shared<const Series>(merged(parts, max_gap_s));
      say_left_out(parts, max_gap_s, data);
    } else {
      const auto whole = source.series ? source.series : std::make_shared<const Series>(std::move(parts.front()));
      data.series = with_gaps_closed(whole, max_gap_s);
      if (data.series != whole) say_left_out({whole.get(), 1}, max_gap_s, data);
    }
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()));
  }
  data.series = without_sensor_jumps(data.series);
  data.targets = measured_names(*data.series);
  return data;
}

ModelData with_own_zeros(ModelData data) {
  if (data.level != Level::series || !data.series->runs.empty()) return data;
  const std::vector<RowRange> sessions = sessions_of(*data.series, data.targets);
  if (sessions.empty()) return data;
  const std::optional<double> zero_s = data.series->started ? seconds_of_stamp(*data.series->started) : std::nullopt;
  std::vector<Series> runs;
  std::vector<std::string> names;
  for (const RowRange& rows : sessions) {
    runs.push_back(rows_of(*data.series, rows));
    const double begin_s = runs.back().time_s.front();
    names.push_back("from " + (zero_s ? stamp_text(*zero_s + begin_s) : duration_text(begin_s)));
  }
  // Their clock is one.
  Stacked all = stacked(runs, names, std::vector<std::optional<double>>(runs.size(), 0.0));
  data.series = std::make_shared<const Series>(std::move(all.series));
  data.remarks.push_back(fmt::format(
      "{}: behind {} the measured values begin at what a probe is set to, such as zero. "
      "The {} parts are read as runs, each with its own zero.",
      data.title, sessions.size() == 2 ? "a pause" : fmt::format("{} pauses", sessions.size() - 1), sessions.size()));
  return data;
}

bool stands_for_runs(const Source& source, std::span<const Reader> readers) {
  if (source.series() || source.recordings() != nullptr) return false;
  return lists_runs(source, readers) || listed({source}, readers).runs.size() > 1;
}

ModelData open_model_data(const std::vector<Source>& sources, const DriftOptions& options,
                          std::optional<double> max_gap_s, std::span<const Reader> readers,
                          const StatedCircle& stated) {
  if (is_recording_file(sources.front(), readers)) return data_of_recordings(sources, readers, stated);
  const Listing listing = listed(sources, readers);
  if (listing.runs.size() == 1)
    return with_own_zeros(data_of_drift(listing.runs.front().source, options, max_gap_s, readers));
  return data_of_runs(listing, options, max_gap_s, readers);
}

}  // namespace ballbar

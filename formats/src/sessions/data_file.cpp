#include "ballbar/formats/sessions/data_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ballbar/circle/trace.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/series/drift_files.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/sessions/runs_toml.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/series/merged_series.hpp"
#include "ballbar/series/runs.hpp"

namespace ballbar {
namespace {

// An empty file and one of another kind, told here with all that would do.
void expect_data(const std::filesystem::path& path, const Reader* reader) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error) || is_archive(path))
    return;  // a folder, or nothing: told by open_drift_data
  if (reads_series(reader) || read_of<ReadSession>(reader) != nullptr) return;
  throw Error(
      fmt::format("{}: expected a log of columns over time (.csv, .xlsx, .mat), a session.toml or recordings (.b5r, "
                  "logs), found {}.",
                  path.string(), found_in(reader)));
}

std::vector<std::string> measured_names(const Series& series) {
  std::vector<std::string> names;
  for (const Column& column : series.columns) {
    if (column.role == Role::measured && column.name.find("_sigma_") == std::string::npos) names.push_back(column.name);
  }
  return names;
}

// A file given twice, under whatever name, would count as two measurements.
void expect_once(const std::vector<std::filesystem::path>& paths) {
  for (auto path = paths.begin(); path != paths.end(); ++path) {
    const auto before = std::find_if(paths.begin(), path, [&](const std::filesystem::path& other) {
      std::error_code absent;  // told where it is opened
      return std::filesystem::equivalent(*path, other, absent);
    });
    if (before == path) continue;
    throw Error(fmt::format("{}: expected each file once, found it again{}.", path->string(),
                            *before == *path ? "" : fmt::format(", the same as {}", before->string())));
  }
}

// The axes of an effect on recordings are those of the plane.
void expect_one_plane(const std::vector<Recording>& recordings, const std::filesystem::path& last) {
  for (const Recording& recording : recordings) {
    if (recording.plane == recordings.front().plane) continue;
    throw Error(
        fmt::format("{}: expected recordings of one plane, whose axes the effects are of, found {} after {}; "
                    "each plane is diagnosed alone.",
                    last.string(), name_of(recording.plane), name_of(recordings.front().plane)));
  }
}

ModelData data_of_recordings(const std::vector<std::filesystem::path>& paths, std::span<const Reader> readers,
                             const StatedCircle& stated) {
  ModelData data;
  data.level = Level::recording;
  expect_once(paths);
  std::vector<Recording> recordings;
  for (const std::filesystem::path& path : paths) {
    if (!is_recording_file(path, readers)) {
      throw Error(fmt::format("{}: expected a recording as the other files are, a .b5r or a log, found something else.",
                              path.string()));
    }
    RecordingFile file = open_recording(path, readers, stated);
    expect_readings(file, path);
    std::move(file.recordings.begin(), file.recordings.end(), std::back_inserter(recordings));
    expect_one_plane(recordings, path);
  }
  data.title = paths.size() == 1 ? paths.front().string()
                                 : fmt::format("{} recordings of {} files, {} to {}", recordings.size(), paths.size(),
                                               paths.front().string(), paths.back().string());
  const bool one = std::all_of(recordings.begin(), recordings.end(),
                               [&](const Recording& r) { return r.motion == recordings.front().motion; });
  if (one && !recordings.empty()) data.motion = recordings.front().motion;
  data.series = trace_of(recordings);
  data.targets = {"deviation_um"};
  data.files = paths;
  return data;
}

// A series, or a session with its signals.
ModelData data_of_drift(const std::filesystem::path& path, const DriftOptions& options, double max_gap_s,
                        std::span<const Reader> readers) {
  expect_data(path, reader_of_file(path, readers));
  return model_data_of(open_drift_data(path, readers), path, options, max_gap_s, readers);
}

// A file that lists runs stands for them.
std::vector<RunOfMachine> listed(const std::vector<std::filesystem::path>& paths, std::span<const Reader> readers,
                                 std::string& title) {
  std::vector<RunOfMachine> runs;
  for (const std::filesystem::path& path : paths) {
    if (!lists_runs(path, readers)) {
      runs.push_back({path.string(), std::nullopt});
      continue;
    }
    const RunsOfMachine list = read_run_list(read_bytes(path, kLargestText), path.string());
    if (paths.size() == 1) title = list.title;
    for (const RunOfMachine& run : list.runs) runs.push_back({(path.parent_path() / run.file).string(), run.start});
  }
  return runs;
}

ModelData data_of_runs(const std::vector<RunOfMachine>& listed_runs, const std::string& title,
                       const DriftOptions& options, double max_gap_s, std::span<const Reader> readers) {
  const std::vector<std::filesystem::path> paths = [&] {
    std::vector<std::filesystem::path> all;
    all.reserve(listed_runs.size());
    for (const RunOfMachine& run : listed_runs) all.emplace_back(run.file);
    return all;
  }();
  expect_once(paths);
  ModelData data;
  std::vector<Series> runs;
  std::vector<std::string> names;
  runs.reserve(paths.size());
  names.reserve(paths.size());
  for (const std::filesystem::path& path : paths) {
    ModelData one = data_of_drift(path, options, max_gap_s, readers);
    runs.push_back(std::move(one.series));
    names.push_back(path.string());
    data.files.insert(data.files.end(), one.files.begin(), one.files.end());
    data.remarks.insert(data.remarks.end(), one.remarks.begin(), one.remarks.end());
  }
  Stacked all = stacked(runs, names);
  data.series = std::move(all.series);
  data.remarks.insert(data.remarks.end(), all.remarks.begin(), all.remarks.end());
  for (std::size_t run = 0; run < data.series.runs.size(); ++run) {
    if (listed_runs[run].start) data.series.runs[run].start = *listed_runs[run].start;
  }
  data.title =
      fmt::format("{} runs, {}", paths.size(), title.empty() ? fmt::format("{}", fmt::join(names, ", ")) : title);
  data.targets = measured_names(data.series);
  return data;
}

}  // namespace

ModelData model_data_of(const DriftData& source, const std::filesystem::path& path, const DriftOptions& options,
                        double max_gap_s, std::span<const Reader> readers) {
  ModelData data;
  data.title = path.string();
  data.files = source.files;
  data.remarks = source.remarks;
  std::vector<Series> parts;
  if (source.series) {
    parts.push_back(*source.series);
  } else {
    if (!source.session->session.title.empty()) data.title = source.session->session.title;
    for (const SkippedFile& one : source.session->skipped) data.remarks.push_back("left out: " + one.why);
    parts.push_back(series_of(drift_of(source.session->session, options)));
    for (const std::filesystem::path& signals : source.session->signals) {
      OpenedSeries opened = opened_series(signals, readers);
      parts.push_back(std::move(opened.series));
      data.remarks.insert(data.remarks.end(), opened.remarks.begin(), opened.remarks.end());
    }
  }
  const std::optional<std::string> started = parts.front().started;
  try {
    data.series = merged(parts, max_gap_s);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()));
  }
  if (parts.size() == 1) data.series.started = started;  // the zero of its clock stays
  data.targets = measured_names(data.series);
  return data;
}

ModelData open_model_data(const std::vector<std::filesystem::path>& paths, const DriftOptions& options,
                          double max_gap_s, std::span<const Reader> readers, const StatedCircle& stated) {
  if (is_recording_file(paths.front(), readers)) return data_of_recordings(paths, readers, stated);
  std::string title;
  const std::vector<RunOfMachine> runs = listed(paths, readers, title);
  if (runs.size() == 1) return data_of_drift(runs.front().file, options, max_gap_s, readers);
  return data_of_runs(runs, title, options, max_gap_s, readers);
}

}  // namespace ballbar

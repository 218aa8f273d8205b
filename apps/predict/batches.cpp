// The recorded tests that `train` works on.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/column_named.hpp"
#include "ballbar/formats/models/runs_csv.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "model/model_options.hpp"
#include "predict/train.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kTold = 5;  // batches with steps

// Throws Error where a batch has a temperature that the first has not: it would be forgotten silently.
void expect_no_more(const Series& series, const BatchColumns& columns, const std::vector<std::string>& left_out,
                    const std::string& first) {
  for (const Column& column : series.columns) {
    if (!is_sensor(column) || column.name == columns.target) continue;
    const auto is_it = [&](const std::string& name) { return name == column.name; };
    if (std::any_of(columns.sensors.begin(), columns.sensors.end(), is_it)) continue;
    if (std::any_of(left_out.begin(), left_out.end(), is_it)) continue;
    throw Error(fmt::format("expected the temperatures of {}, found {} in addition.", first, column.name));
  }
}

void take_out(std::vector<ListedRun>& runs, const std::vector<std::string>& without) {
  const std::vector<ListedRun> all = runs;
  for (const std::string& name : without) {
    const auto same = [&](const ListedRun& run) { return run.name == name; };
    if (std::none_of(all.begin(), all.end(), same)) {
      std::vector<std::string_view> known;
      known.reserve(all.size());
      for (const ListedRun& run : all) known.emplace_back(run.name);
      throw Error(fmt::format("--without {}: expected a batch of the list, found none of that name{}.", name,
                              known.empty() ? "" : fmt::format("; the nearest is {}", nearest_name(name, known))));
    }
    std::erase_if(runs, same);
  }
}

std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t kSome = 4;
  if (names.size() <= kSome) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{} and {} more", fmt::join(names.begin(), names.begin() + kSome, ", "), names.size() - kSome);
}

void tell_steps(const std::vector<Batch>& batches, const std::string& target, std::vector<std::string>& remarks) {
  std::size_t more = 0;
  for (const Batch& batch : batches) {
    if (batch.steps.empty()) continue;
    if (remarks.size() >= kTold) {
      ++more;
      continue;
    }
    const auto& [time_s, um] = batch.steps.front();
    remarks.push_back(fmt::format(
        "{}: {} steps by {:.1f} um at {:.0f} s{}, as if a probe had been touched. --without {} leaves it out.",
        batch.name, target, um, time_s, batch.steps.size() > 1 ? " and elsewhere" : "", batch.name));
  }
  if (more > 0) remarks.push_back(fmt::format("Such steps are in {} more batch{}.", more, more == 1 ? "" : "es"));
}

}  // namespace

Series read_batch(const Source& source, const std::optional<double>& max_gap_s, bool says_how) {
  OpenedSeries opened = opened_series(source);
  const DriftData drift{std::nullopt, std::move(opened.series), {}, std::move(opened.remarks)};
  const ModelData data = model_data_of(drift, source.name(), {}, max_gap_s);
  if (says_how) tell(data.remarks);
  return *data.series;
}

std::string target_of(const TrainOptions& options, const Series& run) {
  if (!options.target.empty()) return column_named(run, options.target);
  std::vector<std::string> measured;
  for (const Column& column : run.columns) {
    if (is_target(column)) measured.push_back(column.name);
  }
  if (measured.size() == 1) return measured.front();
  throw Error(fmt::format("{}: expected one measured column to predict, found {}; name it by --target, one of {}.",
                          options.title(), measured.empty() ? "none" : fmt::format("{}", fmt::join(measured, ", ")),
                          fmt::join(measured.empty() ? column_names(run) : measured, ", ")));
}

OpenedBatches open_batches(const TrainOptions& options) {
  RunList list = open_runs(options.data.front().path());
  take_out(list.runs, options.without);
  std::vector<std::string> remarks;
  std::erase_if(list.runs, [&](const ListedRun& run) {
    std::error_code absent;  // then it is not the same file
    if (options.job.empty() || !options.job.is_path() ||
        !std::filesystem::equivalent(run.file, options.job.path(), absent))
      return false;
    remarks.push_back(fmt::format("{} is the job itself. It is left out.", run.name));
    return true;
  });
  if (list.runs.size() < 2) {
    throw Error(fmt::format("{}: expected at least 2 batches, found {}.", options.title(), list.runs.size()));
  }
  const ProgressLine progress;
  OpenedBatches opened;
  std::vector<std::string> without_sensor;
  opened.remarks = std::move(remarks);
  for (const ListedRun& run : list.runs) {
    const std::string file = run.file.string();
    if (opened.batches.size() % 20 == 0) {
      show_progress(fmt::format("reading batch {} of {}", opened.batches.size() + 1, list.runs.size()));
    }
    const Series series = read_batch(options.batch(run.file), options.max_gap_s, true);
    with_source(file, [&] {
      if (opened.batches.empty()) {
        without_sensor = columns_named(series, options.without_sensor);
        const auto room = options.room ? std::optional(column_named(series, *options.room)) : std::nullopt;
        opened.columns = batch_columns(series, options.inputs, target_of(options, series), room);
        const std::vector<std::string> all = opened.columns.sensors;
        for (const std::string& sensor : without_sensor) {
          std::erase(opened.columns.sensors, sensor);
          if (std::find(all.begin(), all.end(), sensor) != all.end()) continue;
          throw Error(fmt::format("--without-sensor {}: expected a temperature, found none of that name.", sensor));
        }
        if (opened.columns.sensors.empty()) {
          throw Error("--without-sensor: expected at least one temperature to remain, found all of them named.");
        }
      }
      expect_no_more(series, opened.columns, without_sensor, list.runs.front().name);
      opened.batches.push_back(batch_of(run.name, series, opened.columns));
    });
    opened.files.push_back(run.file);
  }
  opened.files.push_back(options.data.front().path());

  tell_steps(opened.batches, opened.columns.target, opened.remarks);
  std::vector<std::string> leave;
  for (const std::string& sensor : constant_sensors(opened.batches, opened.columns)) {
    opened.remarks.push_back(fmt::format("{} is constant in all batches. It is left out.", sensor));
    leave.push_back(sensor);
  }
  for (const BrokenSensor& broken : broken_sensors(opened.batches, opened.columns)) {
    opened.remarks.push_back(fmt::format("{} is off by {:+.1f} K in {} of {} batches ({}). It looks broken and is {}.",
                                         broken.sensor, broken.off_K, broken.batches.size(), opened.batches.size(),
                                         some_of(broken.batches), options.keep_broken ? "kept" : "left out"));
    if (!options.keep_broken) leave.push_back(broken.sensor);
  }
  if (!options.job.empty()) with_source(options.title(), [&] { expect_room(opened.columns); });
  if (!opened.columns.room.empty() && std::find(leave.begin(), leave.end(), opened.columns.room) != leave.end()) {
    opened.remarks.push_back(
        fmt::format("{} is the room temperature that ranks the batches. Do not trust the ranking; choose "
                    "another column with --room.",
                    opened.columns.room));
  }
  with_source(options.title(), [&] { leave_out_sensors(opened.batches, opened.columns, leave); });
  return opened;
}

}  // namespace ballbar

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "ballbar/error.hpp"
#include "ballbar/formats/series/drift_files.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "compensate/compensate.hpp"
#include "compensate/compensation_results.hpp"
#include "compensate/offset_text.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

struct Recorded {
  std::vector<Series> signals;
  Series measured;
  std::string title;
  std::vector<std::filesystem::path> files;
};

Recorded open_recorded(const Source& data) {
  DriftData source = open_drift_data(data);
  tell(source.remarks);
  Recorded recorded{{}, {}, data.name(), source.files};
  if (source.series) {
    recorded.signals.push_back(*source.series);
    recorded.measured = *source.series;
    return recorded;
  }
  const SessionFiles& files = *source.session;
  if (!files.session.title.empty()) recorded.title = files.session.title;
  if (files.signals.empty()) {
    throw Error(fmt::format("{}: expected a session with signals, which the model reads, found none.", data.name()));
  }
  recorded.measured = series_of(drift_of(files.session, {}));
  for (const Source& signal : files.signals) recorded.signals.push_back(open_series(signal));
  return recorded;
}

// Where much was held: the gain is less than the model could give.
std::string held_sentence(const ReplayedAxis& axis, std::size_t rows) {
  const std::size_t held = rows - axis.rows_held[0];
  if (100 * held < rows) return "";
  const auto most = std::max_element(axis.rows_held.begin() + 1, axis.rows_held.end());
  const Hold why = Hold(most - axis.rows_held.begin());
  const std::string column = is_about_a_column(why) ? " of " + shortened(axis.most_held_by, 60) : "";
  return fmt::format(" It was held in {} of {} rows, most of them for {}{}.", held, rows, name_of(why), column);
}

// "each value", "stretches of 40 values": as long as the errors after it stay correlated.
std::string stretches_text(const Replay& replay) {
  std::size_t longest = 1;
  for (const ReplayedAxis& axis : replay.axes) longest = std::max(longest, axis.reduction.stretch);
  if (longest == 1) return "each value";
  return fmt::format("stretches of up to {} values, over which the residual is correlated,", longest);
}

void print(const Replay& replay, const CompensationOptions& options, const Recorded& recorded) {
  fmt::print("{}\n", recorded.title);
  std::string conclusion;
  for (const ReplayedAxis& axis : replay.axes) {
    conclusion += fmt::format("{}{}: {} % less RMS, {} um instead of {} um.{}", conclusion.empty() ? "" : " ",
                              axis.name, percent_text(axis.reduction), fixed(axis.reduction.after_um, 3),
                              fixed(axis.reduction.before_um, 3), held_sentence(axis, replay.rows));
  }
  fmt::print("{} rows of signals, replayed as they came\n\n{}\n{}\n", replay.rows, wrapped(conclusion),
             wrapped(parameters_text(options, recorded.files)));
  Table table({"axis", "target", "values", "RMS before um", "after um", "less %", "largest before um", "after um",
               "rows held"});
  for (const ReplayedAxis& axis : replay.axes) {
    const std::string held = held_text(axis.rows_held);
    table.add({axis.name, axis.target, fmt::format("{}", axis.time_s.size() - 1), fixed(axis.reduction.before_um, 3),
               fixed(axis.reduction.after_um, 3), percent_text(axis.reduction), fixed(largest_of(axis.before_um), 3),
               fixed(largest_of(axis.after_um), 3), held.empty() ? "0" : held});
  }
  fmt::print(
      "{}\n{}", table.text(table_width()),
      wrapped(fmt::format("Errors since the first value, which is left out. An error is met by the offset of the "
                          "last row before it; nothing later is used. ± is one sigma by leaving out {} in turn.",
                          stretches_text(replay))));
}

// All axes on the times of all of them; a gap where one has no value.
Series table_of(const Replay& replay) {
  Series series;
  for (const ReplayedAxis& axis : replay.axes) {
    series.time_s.insert(series.time_s.end(), axis.time_s.begin(), axis.time_s.end());
  }
  std::sort(series.time_s.begin(), series.time_s.end());
  series.time_s.erase(std::unique(series.time_s.begin(), series.time_s.end()), series.time_s.end());
  const auto add = [&](const std::string& name, const ReplayedAxis& axis, const std::vector<double>& values) {
    Column column{name, Role::measured, std::vector<double>(series.time_s.size(), std::nan(""))};
    std::size_t i = 0;
    for (std::size_t row = 0; row < series.time_s.size() && i < axis.time_s.size(); ++row) {
      if (series.time_s[row] == axis.time_s[i]) column.values[row] = values[i++];
    }
    series.columns.push_back(std::move(column));
  };
  for (const ReplayedAxis& axis : replay.axes) {
    add(axis.name + "_before_um", axis, axis.before_um);
    add(axis.name + "_after_um", axis, axis.after_um);
    add(axis.name + "_offset_um", axis, axis.offset_um);
  }
  return series;
}

}  // namespace

TableOf<ReplayedAxis> replayed_axes(const Replay& replay) {
  TableOf<ReplayedAxis> axes;
  for (const ReplayedAxis& axis : replay.axes) axes.emplace_back(axis.name, axis);
  return axes;
}

TableOf<std::size_t> rows_by_hold(const ReplayedAxis& axis) {
  TableOf<std::size_t> rows;
  for (std::size_t kind = 1; kind < kHoldKinds; ++kind) {
    if (axis.rows_held[kind] > 0) rows.emplace_back(name_of(Hold(kind)), axis.rows_held[kind]);
  }
  return rows;
}

void compensate_replay(const CompensationOptions& options, const ReplayOptions& replay) {
  const Recorded recorded = open_recorded(replay.data);
  std::vector<std::filesystem::path> inputs = recorded.files;
  const std::vector<std::filesystem::path> models = paths_of(options.models);
  inputs.insert(inputs.end(), models.begin(), models.end());
  expect_no_input(replay.out, inputs);
  const std::vector<CompensatedAxis> axes = axes_of(options);
  const Replay result = with_source(
      replay.data.name(), [&] { return replay_of(axes, options.limits, recorded.signals, recorded.measured); });
  for (const std::string& path : replay.out) write_bytes(path, write_series(table_of(result)));
  if (replay.json) {
    std::optional<bool> in_sample;
    if (!options.fit.empty()) in_sample = is_in_sample(options, recorded.files);
    print_json(json_of(ReplayResult{result, in_sample}), -1);
  } else {
    print(result, options, recorded);
  }
  for (const std::string& path : replay.out) wrote_line(path);
}

}  // namespace ballbar

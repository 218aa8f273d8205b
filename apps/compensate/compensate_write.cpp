#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/controls/control_file.hpp"
#include "ballbar/formats/logs/column_named.hpp"
#include "ballbar/formats/models/runs_csv.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/predict/train.hpp"
#include "ballbar/series/series.hpp"
#include "compensate/compensate.hpp"
#include "compensate/compensation_results.hpp"
#include "compensate/offset_text.hpp"
#include "model/model_options.hpp"
#include "predict/train.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kHeadWidth = 88;  // of a line of the file's comments

struct Asked {
  Control control;
  std::vector<std::string> columns;  // none: the best
  std::size_t count = 1;
};

// "siemens", "siemens:2", "siemens:T_a_degC,T_b_degC"
Asked asked_of(const std::string& text) {
  const std::size_t colon = text.find(':');
  Asked asked{control_of(text.substr(0, colon)), {}, 1};
  if (colon == std::string::npos) return asked;
  std::string rest = text.substr(colon + 1);
  if (rest.size() == 1 && rest.front() >= '0' && rest.front() <= '9') {
    asked.count = static_cast<std::size_t>(rest.front() - '0');
    return asked;
  }
  for (std::size_t from = 0; from <= rest.size();) {
    const std::size_t to = std::min(rest.find(',', from), rest.size());
    const std::string column = rest.substr(from, to - from);
    if (column.empty()) {
      throw Error(fmt::format("expected CONTROL, CONTROL:NUMBER of sensors or CONTROL:COLUMN,COLUMN, found {}.",
                              in_quotes(text)));
    }
    if (std::find(asked.columns.begin(), asked.columns.end(), column) != asked.columns.end()) {
      throw Error(fmt::format("expected each sensor once, found {} again.", in_quotes(column)));
    }
    asked.columns.push_back(column);
    from = to + 1;
  }
  asked.count = asked.columns.size();
  return asked;
}

std::vector<std::string> candidates_of(const Asked& asked, const Series& data, const std::string& target) {
  std::vector<std::string> sensors;
  for (const Column& column : data.columns) {
    if (is_sensor(column) && column.name != target) sensors.push_back(column.name);
  }
  if (asked.columns.empty()) return sensors;
  const std::vector<std::string> columns = columns_named(data, asked.columns);
  for (const std::string& name : columns) {
    if (std::find(sensors.begin(), sensors.end(), name) == sensors.end() && find_column(data, name) != nullptr) {
      throw Error(fmt::format("expected sensors of temperature (_degC or _K), found {}; there are {}.", name,
                              fmt::join(sensors, ", ")));
    }
  }
  return columns;
}

// A series, a session or runs; of a list of recorded tests these, one after the other.
ModelData open_write_data(const Source& data) {
  if (!lists_batches({data})) return open_drift(data, std::nullopt);
  ModelData opened;
  opened.title = data.name();
  opened.files.push_back(data.path());
  std::vector<Series> runs;
  std::vector<std::string> names;
  for (const ListedRun& run : open_runs(data.path()).runs) {
    runs.push_back(with_source(run.file.string(), [&] {
      return *with_gaps_closed(std::make_shared<const Series>(open_series(Source(run.file))), std::nullopt);
    }));
    names.push_back(run.name);
    opened.files.push_back(run.file);
  }
  Stacked all = with_source(data.name(), [&] { return stacked(runs, names); });
  tell(all.remarks);
  opened.series = std::make_shared<const Series>(std::move(all.series));
  return opened;
}

std::string sensors_text(const LinearCompensation& line) {
  std::vector<std::string> names;
  for (const SensorSlope& sensor : line.sensors) names.push_back(one_line(sensor.column));
  constexpr const char* kCounts[] = {"one sensor", "two sensors", "three sensors"};
  return fmt::format("{}, {}, linear", kCounts[names.size() - 1], fmt::join(names, " and "));
}

std::string conclusion(const std::string& axis, const Simplification& result) {
  const LineErrors& errors = result.left_out ? *result.left_out : result.fitted;
  return fmt::format("{} by {}: {} um with this line, {} um with the model, {} um without compensation.", axis,
                     sensors_text(result.line), fixed(errors.line.after_um, 2), fixed(errors.model.after_um, 2),
                     fixed(errors.line.before_um, 2));
}

std::string tested_text(const Simplification& result) {
  if (!result.left_out) {
    return "These values are those of the fit, because too few could be left out. On new values the error is larger.";
  }
  const LineErrors& errors = *result.left_out;
  const std::string how =
      result.runs > 1
          ? fmt::format("Each of {} runs was left out in turn; sensors and slopes were then chosen from the others.",
                        result.runs)
          : "These values are the last two fifths of the record; sensors and slopes were chosen from the rows before "
            "each "
            "fifth.";
  if (errors.beyond == 0) return how;
  return fmt::format("{} In {} of {} values a reading was beyond the ends of the line.", how, errors.beyond,
                     errors.values);
}

void print(const std::string& title, const std::string& axis, const std::string& parameters,
           const Simplification& result) {
  fmt::print("{}\n{}\n{}\n", title, wrapped(conclusion(axis, result)), wrapped(tested_text(result) + " " + parameters));
  Table sensors({"sensor", "slope um/K", "zero at", "from", "to"});
  for (const SensorSlope& sensor : result.line.sensors) {
    sensors.add({one_line(sensor.column), with_sigma(sensor.slope_um_per_K, sensor.sigma_um_per_K, 3),
                 fixed(sensor.zero, 1), fixed(sensor.low, 1), fixed(sensor.high, 1)});
  }
  fmt::print("{}\n", sensors.text(table_width()));
  Table table({"values", "n", "without um", "model um", "line um", "model gain %", "line gain %", "largest um",
               "model um", "line um"});
  const auto add = [&](const char* name, const LineErrors& errors) {
    table.add({name, fmt::format("{}", errors.values), fixed(errors.line.before_um, 2), fixed(errors.model.after_um, 2),
               fixed(errors.line.after_um, 2), percent_text(errors.model), percent_text(errors.line),
               fixed(errors.largest_um, 2), fixed(errors.largest_model_um, 2), fixed(errors.largest_line_um, 2)});
  };
  if (result.left_out) add("left out", *result.left_out);
  add("fitted to", result.fitted);
  fmt::print("{}\n{}", table.text(table_width()),
             wrapped(fmt::format("RMS and largest errors relative to the first value of each run. ± is one sigma: of a "
                                 "slope by leaving out {} in turn, of % by leaving out stretches. The line is as "
                                 "written: its slopes are rounded and its result {} {} um. It differs by {} um RMS "
                                 "from the model.",
                                 result.runs > 1 ? "each run" : "each fifth of the record",
                                 result.line.increment.toward_zero ? "is cut to whole steps of" : "is rounded to",
                                 fmt::format("{:g}", result.line.increment.um), fixed(result.from_model_um, 2))));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return lines;
}

}  // namespace

void compensate_write(const CompensationOptions& options, const WriteOptions& write) {
  const Asked asked = with_source("--write", [&] { return asked_of(write.control); });
  const ControlKind& kind = kind_of(asked.control);
  if (write.out.size() != 1 || !write.out.front().ends_with(kind.ending)) {
    throw Error(fmt::format("--write: expected one --out with a name that ends in {} for {}, found {}.", kind.ending,
                            kind.word, write.out.empty() ? "none" : fmt::format("{}", fmt::join(write.out, ", "))));
  }
  const ModelData data = open_write_data(write.data);
  std::vector<std::filesystem::path> inputs = data.files;
  for (const std::vector<Source>& sources : {options.models, options.fit}) {
    const std::vector<std::filesystem::path> paths = paths_of(sources);
    inputs.insert(inputs.end(), paths.begin(), paths.end());
  }
  expect_no_input(write.out, inputs);
  const std::vector<CompensatedAxis> axes = axes_of(options);
  if (axes.size() != 1) {
    throw Error(
        fmt::format("--write: expected a model of one target, found {}. Write each to its own file.", axes.size()));
  }
  const CompensatedAxis& axis = axes.front();
  const std::string& target = axis.model.targets.front();
  const Simplification result = with_source(write.data.name(), [&] {
    return simplified(axis.model, *data.series, candidates_of(asked, *data.series, target), asked.count,
                      options.limits.range_margin, increment_of(asked.control, options.limits.resolution_um));
  });
  const LineErrors& judged = result.left_out ? *result.left_out : result.fitted;
  if (!(judged.line.after_um < judged.line.before_um)) {
    throw Error(
        fmt::format("{}: expected a line that lowers the error, found {:.2f} um with it and {:.2f} um without it.",
                    write.data.name(), judged.line.after_um, judged.line.before_um));
  }
  const std::string parameters = parameters_text(options, data.files);
  ControlLine line{axis.name, result.line, options.limits.rate_um_per_s, {}};
  if (write.reversed) {
    for (SensorSlope& sensor : line.line.sensors) sensor.slope_um_per_K *= -1.0;
  }
  line.comments = lines_of(wrapped(fmt::format("Model {} on {}. {} {} {}{}", options.models.front().name(),
                                               write.data.name(), conclusion(axis.name, result), tested_text(result),
                                               parameters, write.reversed ? " The sign is reversed." : ""),
                                   kHeadWidth));
  write_bytes(write.out.front(), control_file(asked.control, line));
  if (write.json) {
    WrittenResult written{std::string(kind.word), write.out.front(), axis.name, target, std::nullopt, result};
    if (!options.fit.empty()) written.in_sample = is_in_sample(options, data.files);
    print_json(json_of(written), -1);
  } else {
    print(data.title, axis.name, parameters, result);
  }
  wrote_line(write.out.front());
}

}  // namespace ballbar

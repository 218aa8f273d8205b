#include "predict/predicted_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/batch_model_json.hpp"
#include "ballbar/formats/models/effect_regression_json.hpp"
#include "ballbar/formats/models/prediction_state.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/internal/number_text.hpp"
#include "predict/predict_results.hpp"
#include "predict/train.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/state_file.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kToldParts = 6;  // drivers, warnings

std::string source_name(const Source& data) { return data.name() == "-" ? "standard input" : data.name(); }

// From a file or, of "-", from the standard input.
Series read_data(const Source& data, const std::optional<double>& max_gap_s) {
  if (data.name() != "-") return read_batch(data, max_gap_s, true);
  std::string bytes;
  char block[1 << 16];
  while (std::cin.read(block, sizeof block) || std::cin.gcount() > 0) {
    bytes.append(block, static_cast<std::size_t>(std::cin.gcount()));
    if (bytes.size() > kLargestTable) throw Error("standard input: expected at most 1 GiB, found more.");
  }
  return read_series(bytes, "standard input");
}

Series series_of(const PredictedJob& job) {
  const RegressionPrediction& prediction = job.prediction;
  const std::string stem = stem_of(job.target);
  Series series;
  series.time_s = job.data.time_s;
  series.columns.push_back({stem + "_model_um", Role::measured, prediction.predicted_um});
  series.columns.push_back({stem + "_half_width_um", Role::measured, prediction.half_width_um});
  if (const Column* measured = find_column(job.data, job.target)) {
    Column residual{stem + "_residual_um", Role::measured, measured->values};
    for (std::size_t i = 0; i < residual.values.size(); ++i) residual.values[i] -= prediction.predicted_um[i];
    series.columns.push_back(*measured);
    series.columns.push_back(std::move(residual));
  }
  if (!prediction.T2_of_largest.empty()) {
    series.columns.push_back({"T2_of_largest", Role::event, prediction.T2_of_largest});
    series.columns.push_back({"Q_of_largest", Role::event, prediction.Q_of_largest});
  }
  for (std::size_t d = 0; d < prediction.drivers.size(); ++d) {
    const auto adds = prediction.drivers_um.col(static_cast<Eigen::Index>(d));
    series.columns.push_back(
        {fmt::format("{}_by_{}_um", stem, prediction.drivers[d].column), Role::measured, {adds.begin(), adds.end()}});
  }
  return series;
}

void expect_prediction(const PredictedJob& job) {
  const std::vector<double>& um = job.prediction.predicted_um;
  if (std::any_of(um.begin(), um.end(), [](double value) { return std::isfinite(value); })) return;
  throw Error(fmt::format(
      "{}: expected a row with a value in every column of the model, and a finite prediction there, found none.",
      job.source));
}

// " from 0.07 to 24.45 um, at the end 24.45 um ±5.37 um (95 %)", of the rows that have a prediction.
std::string range_text(const RegressionPrediction& prediction) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < prediction.predicted_um.size(); ++i) {
    if (std::isfinite(prediction.predicted_um[i])) rows.push_back(i);
  }
  const auto less = [&](std::size_t a, std::size_t b) {
    return prediction.predicted_um[a] < prediction.predicted_um[b];
  };
  const auto [low, high] = std::minmax_element(rows.begin(), rows.end(), less);
  const std::size_t without = prediction.predicted_um.size() - rows.size();
  return fmt::format(" from {:.2f} to {:.2f} um, at the end {:.2f} um ±{:.2f} um (95 %){}\n",
                     prediction.predicted_um[*low], prediction.predicted_um[*high],
                     prediction.predicted_um[rows.back()], prediction.half_width_um[rows.back()],
                     without > 0 ? fmt::format("; {} rows have no value in some column", without) : "");
}

// "of 18.20 um: speed_rpm 11.10, T4_degC 5.20, 3 more 1.90; not attributable 1.20"
std::string drivers_text(const EffectRegression& model, const RegressionPrediction& prediction) {
  double range = 0.0, more = 0.0;
  std::vector<std::string> parts;
  for (const DriverShare& driver : prediction.drivers) {
    range += driver.share_um;
    if (parts.size() < kToldParts) {
      const bool has_role = driver.role == Role::ambient || driver.role == Role::coolant;
      parts.push_back(fmt::format("{}{} {:.2f}", driver.column,
                                  has_role ? fmt::format(" ({})", name_of(driver.role)) : "", driver.share_um));
    } else {
      more += driver.share_um;
    }
  }
  if (prediction.drivers.size() > kToldParts) {
    parts.push_back(fmt::format("{} more {:.2f}", prediction.drivers.size() - kToldParts, more));
  }
  return fmt::format(
      "Shares of the range of the prediction, {:.2f} um: {}; not attributable {:.2f} (standard deviation).", range,
      fmt::join(parts, ", "), model.sigma_um);
}

std::vector<std::string> temperature_warnings(const RegressionPrediction& prediction) {
  std::vector<std::string> warnings;
  if (prediction.broken.size() == 1) {
    warnings.push_back(fmt::format(
        "{} looks broken: with the value that the other sensors suggest, the rows resemble those of the training.",
        prediction.broken.front()));
  } else if (!prediction.broken.empty()) {
    warnings.push_back(
        fmt::format("{} does not agree with the other sensors, or the job differs from those of the training.",
                    fmt::join(prediction.broken, " or ")));
  }
  const Extrapolation extrapolation = extrapolation_of(prediction);
  if (extrapolation.matters) {
    warnings.push_back(
        fmt::format("{} of {} rows are outside the range of the training (Hotelling T2), {} have another "
                    "pattern (Q). There the model extrapolates. Its interval is wider and less reliable.",
                    extrapolation.far, prediction.predicted_um.size(), extrapolation.odd));
  }
  const std::vector<OutsideRange>& outside = prediction.outside;
  for (std::size_t i = 0; i < std::min(outside.size(), kToldParts); ++i) {
    const OutsideRange& one = outside[i];
    const std::string_view unit = unit_of(one.what) == "degC" ? "degC" : "K";
    warnings.push_back(
        fmt::format("{} reaches {:.1f} {} in {} rows from {:.0f} s on; in training it was {:.1f} to {:.1f}.", one.what,
                    one.value, unit, one.rows, one.time_s, one.low, one.high));
  }
  if (outside.size() > kToldParts)
    warnings.push_back(fmt::format("The range is left by {} more column{}.", outside.size() - kToldParts,
                                   outside.size() == kToldParts + 1 ? "" : "s"));
  return warnings;
}

// The farthest first, by the spans that were trained.
std::vector<std::string> effect_warnings(const RegressionPrediction& prediction) {
  std::vector<OutsideRange> outside = prediction.outside;
  if (outside.empty()) return {};
  const auto beyond = [](const OutsideRange& one) {
    return std::max(one.low - one.value, one.value - one.high) / std::max(one.high - one.low, 1e-12);
  };
  std::stable_sort(outside.begin(), outside.end(),
                   [&](const OutsideRange& a, const OutsideRange& b) { return beyond(a) > beyond(b); });
  std::vector<std::string> parts;
  for (const OutsideRange& one : outside) {
    if (parts.size() == kToldParts) break;
    parts.push_back(fmt::format("{} reaches {:g} (trained: {:g} to {:g})", one.what, one.value, one.low, one.high));
  }
  if (outside.size() > kToldParts) parts.push_back(fmt::format("{} more", outside.size() - kToldParts));
  const double first_s = std::min_element(outside.begin(), outside.end(), [](const auto& a, const auto& b) {
                           return a.time_s < b.time_s;
                         })->time_s;
  return {fmt::format("From {:.0f} s on the model extrapolates: {}.", first_s, fmt::join(parts, ", "))};
}

// The rows after the last one that was predicted.
Series rows_after(Series data, double last_s) {
  const auto first = std::upper_bound(data.time_s.begin(), data.time_s.end(), last_s);
  const auto known = first - data.time_s.begin();
  data.time_s.erase(data.time_s.begin(), first);
  for (Column& column : data.columns) column.values.erase(column.values.begin(), column.values.begin() + known);
  return data;
}

// A state is no input and no output, and its folder is there.
void expect_state_apart(const PredictOptions& options) {
  if (options.state.empty()) return;
  const std::filesystem::path state(options.state);
  std::vector<std::filesystem::path> others = paths_of({options.model.data.front(), options.model.model});
  others.insert(others.end(), options.out.begin(), options.out.end());
  expect_no_input({options.state}, others, "--state");
  for (const std::filesystem::path& other : others) {
    if (state.lexically_normal() != other.lexically_normal()) continue;
    throw Error(fmt::format("--state {}: expected a separate file, found one that this command reads or writes.",
                            options.state));
  }
  if (state.parent_path().empty() || std::filesystem::is_directory(state.parent_path())) return;
  throw Error(fmt::format("--state {}: expected an existing folder, found none.", options.state));
}

// Where the state's file says that an earlier prediction stood; nothing where there is no file yet.
std::optional<PredictionState> state_of(const std::string& file, const std::string& digest) {
  if (file.empty() || !std::filesystem::exists(file)) return std::nullopt;
  StoredPrediction stored = read_prediction_state(read_bytes(file, kLargestText), file);
  if (stored.model != digest) {
    throw Error(
        fmt::format("{}: expected the state of this model, found that of another one. Without the file a new run "
                    "begins.",
                    file));
  }
  return PredictionState{std::move(stored.live), stored.since_end};
}

std::string start_text(const EffectRegression& model, const RegressionPrediction& prediction, const Series& data,
                       bool from_state) {
  if (from_state) return "Continued from the saved state.";
  if (prediction.holds) {
    return fmt::format("Starts with the training; rows after {} are new.",
                       duration_text(model.end_s - data.time_s.front()));
  }
  if (prediction.goes_on) return "Continued from the end of the training, with the state of filters and slow residual.";
  const bool inside = data.time_s.front() > model.end.time_s[0] && data.time_s.front() < model.end_s;
  return fmt::format(
      "A new run: temperatures and filters start at its first row.{}",
      inside ? " Its times are within those of the training. To continue a record, give it from its first row on."
             : "");
}

// What a kind of regression has to say beside what all say.
struct KindTexts {
  std::string by;       // "pcr, 7 components, 24 batches"
  std::string start;    // how the series begins; empty: no matter
  std::string drivers;  // a paragraph; empty: none
};

// first_new: rows before it were trained on.
void print_and_write(const PredictedJob& job, const PredictOptions& options, const KindTexts& texts,
                     std::size_t first_new, PredictedTarget result) {
  const RegressionPrediction& prediction = job.prediction;
  result.predicted = series_of(job);
  result.warnings = job.warnings;
  if (const Column* measured = find_column(job.data, job.target)) {
    result.error = error_of(prediction, measured->values, first_new);
  }
  for (const std::string& path : options.out) write_bytes(path, write_series(result.predicted));
  if (options.json) {
    print_json(json_of(result), -1);
  } else {
    const std::vector<double>& time_s = job.data.time_s;
    fmt::print("{}\n{}: {} by {}\n{}\n{} rows over {}: {}{}", job.source, options.model.model.name(), job.target,
               texts.by, texts.start.empty() ? "" : texts.start + "\n", time_s.size(),
               duration_text(time_s.back() - time_s.front()), job.target, range_text(prediction));
    if (result.error) {
      fmt::print(
          "measured minus predicted{}: mean absolute error {:.2f} um, RMSE {:.2f} um, {:.0f} % within the 95 % "
          "interval\n",
          first_new > 0 ? fmt::format(", {} new rows", result.error->rows) : "", result.error->mean_um,
          result.error->rmse_um, 100.0 * result.error->within_share);
    }
    if (!texts.drivers.empty()) fmt::print("{}", wrapped(texts.drivers));
    if (!job.warnings.empty()) fmt::print("\n");
    for (const std::string& warning : job.warnings) fmt::print("{}", wrapped(warning));
  }
  for (const std::string& path : options.out) wrote_line(path);
}

}  // namespace

std::string stem_of(const std::string& column) {
  const std::size_t unit = unit_of(column).size();
  return unit == 0 ? column : column.substr(0, column.size() - unit - 1);
}

BatchJob batch_job(const Source& data, const Source& model, const std::optional<double>& max_gap_s, bool anyway) {
  BatchJob made;
  PredictedJob& job = made.job;
  job.source = source_name(data);
  made.model = read_batch_model(model.bytes(kLargestText), model.name());
  job.target = made.model.columns.target;
  job.data = read_data(data, max_gap_s);
  job.prediction = with_source(job.source, [&] { return predict(made.model, job.data); });
  if (job.prediction.broken.size() == 1 && !anyway) {
    throw Error(
        fmt::format("{}: expected sensors as in training, found that {} looks broken. Repair it, train without it "
                    "(--without-sensor), or predict nevertheless with --anyway.",
                    job.source, job.prediction.broken.front()));
  }
  expect_prediction(job);
  job.warnings = temperature_warnings(job.prediction);
  return made;
}

void predict_by_temperatures(const PredictOptions& options) {
  const auto& [model, job] =
      batch_job(options.model.data.front(), options.model.model, options.model.max_gap_s, options.anyway);
  const std::string by = fmt::format("{}, {} batches", label_of(model.settings), model.batches.size());
  PredictedTarget result;
  result.broken = job.prediction.broken;
  print_and_write(job, options, {by, {}, {}}, 0, std::move(result));
}

void predict_by_effects(const PredictOptions& options) {
  const Source& data = options.model.data.front();
  const std::string bytes = options.model.model.bytes(kLargestText);
  const EffectRegression model = read_effect_regression(bytes, options.model.model.name());
  expect_state_apart(options);
  const std::optional<FileLock> lock = options.state.empty() ? std::nullopt : only_program(options.state);
  const std::optional<PredictionState> from = state_of(options.state, digest_of(bytes));
  PredictedJob job{source_name(data), model.model.targets.front(), {}, {}, {}};
  if (data.name() == "-") {
    job.data = read_data(data, options.model.max_gap_s);
  } else {
    const ModelData opened = open_drift(data, options.model.max_gap_s);
    if (opened.series->runs.size() > 1) {
      throw Error(fmt::format("{}: expected one run to predict, found {}. Name its file, or its sheet with --sheet.",
                              data.name(), opened.series->runs.size()));
    }
    expect_no_input(options.out, opened.files);
    job.data = *opened.series;
  }
  if (from && from->live.rows > 0) {
    job.data = rows_after(std::move(job.data), from->live.time_s[from->live.rows - 1]);
  }
  if (job.data.time_s.empty()) {
    throw Error(fmt::format("{}: expected rows after those in {}, found none.", job.source, options.state));
  }
  job.prediction = with_source(from ? options.state : job.source, [&] { return predict(model, job.data, from); });
  const RegressionPrediction& prediction = job.prediction;
  expect_prediction(job);
  job.warnings = effect_warnings(prediction);
  const std::vector<double>& time_s = job.data.time_s;
  const auto first_new =
      prediction.holds ? std::upper_bound(time_s.begin(), time_s.end(), model.end_s) : time_s.begin();
  PredictedTarget result;
  result.goes_on = prediction.goes_on;
  result.holds = prediction.holds;
  result.drivers = prediction.drivers;
  print_and_write(job, options,
                  {fmt::format("effects ({}), trained on {} rows", dictionary_text(model), model.rows),
                   start_text(model, prediction, job.data, from.has_value()), drivers_text(model, prediction)},
                  static_cast<std::size_t>(first_new - time_s.begin()), std::move(result));
  if (options.state.empty()) return;
  write_bytes_durably(options.state,
                      write_prediction_state({digest_of(bytes), prediction.end.since_end, prediction.end.live}));
}

}  // namespace ballbar

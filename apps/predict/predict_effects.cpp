#include "predict/predict_effects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "ballbar/effect_regression/effect_regression.hpp"
#include "ballbar/formats/models/effect_regression_json.hpp"
#include "ballbar/formats/models/prediction_state.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/number_text.hpp"
#include "model/model_options.hpp"
#include "predict/predict_batch.hpp"
#include "predict/predict_result.hpp"
#include "terminal/caller.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/state_file.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kShown = 6;  // drivers, warnings

Series series_of(const EffectRegression& model, const EffectPrediction& prediction, const Series& data) {
  const std::string& target = model.model.targets.front();
  const std::string stem = stem_of(target);
  Series series;
  series.time_s = data.time_s;
  series.columns.push_back({stem + "_model_um", Role::measured, prediction.predicted_um});
  series.columns.push_back({stem + "_half_width_um", Role::measured, prediction.half_width_um});
  if (const Column* measured = find_column(data, target)) {
    Column residual{stem + "_residual_um", Role::measured, measured->values};
    for (std::size_t i = 0; i < residual.values.size(); ++i) residual.values[i] -= prediction.predicted_um[i];
    series.columns.push_back(*measured);
    series.columns.push_back(std::move(residual));
  }
  for (std::size_t d = 0; d < prediction.drivers.size(); ++d) {
    const auto adds = prediction.drivers_um.col(static_cast<Eigen::Index>(d));
    series.columns.push_back(
        {fmt::format("{}_by_{}_um", stem, prediction.drivers[d].column), Role::measured, {adds.begin(), adds.end()}});
  }
  return series;
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
void expect_state_apart(const EffectPredictOptions& options) {
  if (options.state.empty()) return;
  const std::filesystem::path state(options.state);
  std::vector<std::filesystem::path> others = paths_of({options.data, options.model});
  others.insert(others.end(), options.out.begin(), options.out.end());
  expect_no_input({options.state}, others, "--state");
  for (const std::filesystem::path& other : others) {
    if (state.lexically_normal() != other.lexically_normal()) continue;
    throw Error(
        fmt::format("--state {}: expected a file of its own, found one that is read or written here.", options.state));
  }
  if (state.parent_path().empty() || std::filesystem::is_directory(state.parent_path())) return;
  throw Error(fmt::format("--state {}: expected a folder that is there, found none.", options.state));
}

// Where the state's file says that an earlier prediction stood; nothing where there is no file yet.
std::optional<PredictionState> state_of(const std::string& file, const std::string& digest) {
  if (file.empty() || !std::filesystem::exists(file)) return std::nullopt;
  StoredPrediction stored = read_prediction_state(read_bytes(file, kLargestText), file);
  if (stored.model != digest) {
    throw Error(
        fmt::format("{}: expected the state of this model, found one of another. Without the file a new run "
                    "begins.",
                    file));
  }
  return PredictionState{std::move(stored.live), stored.since_end};
}

std::string start_text(const EffectRegression& model, const EffectPrediction& prediction, const Series& data,
                       bool from_state) {
  if (from_state) return "It goes on from where the state stood.";
  if (prediction.holds) {
    return fmt::format("It begins as the training did; what comes after {} is new.",
                       duration_text(model.end_s - data.time_s.front()));
  }
  if (prediction.goes_on) return "It goes on where training ended: filters and the slow curve are kept.";
  const bool inside = data.time_s.front() > model.end.time_s[0] && data.time_s.front() < model.end_s;
  return fmt::format(
      "A run of its own: its first row is the zero of temperatures and filters.{}",
      inside ? " Its times are within those of the training: give the record from its first row on." : "");
}

// Rows after the training alone, where the data hold it.
std::optional<NewRowsError> error_of(const EffectRegression& model, const EffectPrediction& prediction,
                                     const Series& data) {
  const Column* measured = find_column(data, model.model.targets.front());
  if (measured == nullptr) return std::nullopt;
  NewRowsError of;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    const double error = measured->values[i] - prediction.predicted_um[i];
    if (!std::isfinite(error) || (prediction.holds && data.time_s[i] <= model.end_s)) continue;
    of.mean_um += std::abs(error);
    of.rmse_um += error * error;
    of.within += std::abs(error) <= prediction.half_width_um[i] ? 1.0 : 0.0;
    ++of.rows;
  }
  if (of.rows == 0) return std::nullopt;
  const auto n = static_cast<double>(of.rows);
  return NewRowsError{of.mean_um / n, std::sqrt(of.rmse_um / n), of.within / n, of.rows};
}

// " from 0.07 to 24.45 um, at the end 24.45 um ±5.37 um (95 %)", of the rows that have a prediction.
std::string range_text(const EffectPrediction& prediction) {
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
std::string drivers_text(const EffectRegression& model, const EffectPrediction& prediction) {
  double range = 0.0, more = 0.0;
  std::vector<std::string> parts;
  for (const DriverShare& driver : prediction.drivers) {
    range += driver.share_um;
    if (parts.size() < kShown) {
      const bool has_role = driver.role == Role::ambient || driver.role == Role::coolant;
      parts.push_back(fmt::format("{}{} {:.2f}", driver.column,
                                  has_role ? fmt::format(" ({})", name_of(driver.role)) : "", driver.share_um));
    } else {
      more += driver.share_um;
    }
  }
  if (prediction.drivers.size() > kShown) {
    parts.push_back(fmt::format("{} more {:.2f}", prediction.drivers.size() - kShown, more));
  }
  return fmt::format("Of {:.2f} um, the range of what is predicted: {}; not attributable {:.2f} (standard deviation).",
                     range, fmt::join(parts, ", "), model.sigma_um);
}

// The farthest first, by the spans that were trained.
std::vector<std::string> warnings_of(const EffectPrediction& prediction) {
  std::vector<OutsideRange> outside = prediction.outside;
  if (outside.empty()) return {};
  const auto beyond = [](const OutsideRange& one) {
    return std::max(one.low - one.value, one.value - one.high) / std::max(one.high - one.low, 1e-12);
  };
  std::stable_sort(outside.begin(), outside.end(),
                   [&](const OutsideRange& a, const OutsideRange& b) { return beyond(a) > beyond(b); });
  std::vector<std::string> parts;
  for (const OutsideRange& one : outside) {
    if (parts.size() == kShown) break;
    parts.push_back(fmt::format("{} as far as {:g} ({:g} to {:g})", one.column, one.value, one.low, one.high));
  }
  if (outside.size() > kShown) parts.push_back(fmt::format("{} more", outside.size() - kShown));
  const double first_s = std::min_element(outside.begin(), outside.end(), [](const auto& a, const auto& b) {
                           return a.time_s < b.time_s;
                         })->time_s;
  return {fmt::format("From {:.0f} s on columns leave what was trained, and the model extrapolates: {}.", first_s,
                      fmt::join(parts, ", "))};
}

}  // namespace

bool is_effect_regression(const Source& model) { return is_effect_regression_json(model.head(kHeadBytes)); }

void predict_effects(const EffectPredictOptions& options) {
  const std::string bytes = options.model.bytes(kLargestText);
  const EffectRegression model = read_effect_regression(bytes, options.model.name());
  expect_state_apart(options);
  const std::optional<FileLock> lock = options.state.empty() ? std::nullopt : only_program(options.state);
  const std::optional<PredictionState> from = state_of(options.state, digest_of(bytes));
  const bool piped = options.data.name() == "-";
  ModelData opened;
  if (!piped) opened = open_drift(options.data, options.max_gap_s);
  expect_no_input(options.out, opened.files);
  Series data = piped ? read_data(options.data) : *opened.series;
  const std::string source = piped ? "standard input" : options.data.name();
  if (from && from->live.rows > 0) data = rows_after(std::move(data), from->live.time_s[from->live.rows - 1]);
  if (data.time_s.empty()) {
    throw Error(fmt::format("{}: expected rows after those that {} knows, found none.", source, options.state));
  }
  const EffectPrediction prediction =
      with_source(from ? options.state : source, [&] { return predict(model, data, from); });
  if (std::none_of(prediction.predicted_um.begin(), prediction.predicted_um.end(),
                   [](double value) { return std::isfinite(value); })) {
    throw Error(fmt::format("{}: expected a row with a value in every column of the model, found none.", source));
  }
  const Series series = series_of(model, prediction, data);
  for (const std::string& path : options.out) write_bytes(path, write_series(series));
  const std::optional<NewRowsError> error = error_of(model, prediction, data);
  const std::vector<std::string> warnings = warnings_of(prediction);
  if (options.json) {
    const PredictedByEffects result{{series}, prediction.goes_on, prediction.holds, prediction.drivers, error,
                                    warnings};
    print_json(json_of(result), -1);
  } else {
    const std::string& target = model.model.targets.front();
    fmt::print("{}\n{}: {} by effects ({}), trained on {} rows\n{}\n\n", source, options.model.name(), target,
               dictionary_text(model), model.rows, start_text(model, prediction, data, from.has_value()));
    fmt::print("{} rows over {}: {}{}", data.time_s.size(), duration_text(data.time_s.back() - data.time_s.front()),
               target, range_text(prediction));
    if (error) {
      fmt::print(
          "measured less predicted{}: mean of |error| {:.2f} um, RMSE {:.2f} um, {:.0f} % within the 95 % interval\n",
          prediction.holds ? fmt::format(", {} new rows", error->rows) : "", error->mean_um, error->rmse_um,
          100.0 * error->within);
    }
    fmt::print("{}", wrapped(drivers_text(model, prediction)));
    if (!warnings.empty()) fmt::print("\n");
    for (const std::string& warning : warnings) fmt::print("{}", wrapped(warning));
  }
  for (const std::string& path : options.out) wrote_line(path);
  if (options.state.empty()) return;
  write_bytes_durably(options.state,
                      write_prediction_state({digest_of(bytes), prediction.end.since_end, prediction.end.live}));
}

}  // namespace ballbar

#include "predict/predict_batch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>

#include "ballbar/batches/batch_check.hpp"
#include "ballbar/batches/batch_regression.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/models/batch_model_json.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/number_text.hpp"
#include "batches/batches.hpp"
#include "model/model_options.hpp"
#include "predict/predict_result.hpp"
#include "terminal/caller.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kWarned = 6;

}  // namespace

Series read_data(const Source& data) {
  if (data.name() != "-") return read_batch(data);
  std::string bytes;
  char block[1 << 16];
  while (std::cin.read(block, sizeof block) || std::cin.gcount() > 0) {
    bytes.append(block, static_cast<std::size_t>(std::cin.gcount()));
    if (bytes.size() > kLargestTable) throw Error("standard input: expected at most 1 GiB, found more.");
  }
  return read_series(bytes, "standard input");
}

namespace {

Series series_of(const BatchModel& model, const BatchPrediction& prediction, const Series& data) {
  const std::string stem = stem_of(model.columns.target);
  Series series;
  series.time_s = data.time_s;
  series.columns.push_back({stem + "_model_um", Role::measured, prediction.predicted_um});
  series.columns.push_back({stem + "_half_width_um", Role::measured, prediction.half_width_um});
  if (const Column* measured = find_column(data, model.columns.target)) {
    Column residual{stem + "_residual_um", Role::measured, measured->values};
    for (std::size_t i = 0; i < residual.values.size(); ++i) residual.values[i] -= prediction.predicted_um[i];
    series.columns.push_back(*measured);
    series.columns.push_back(std::move(residual));
  }
  series.columns.push_back({"T2_of_largest", Role::event, prediction.T2_of_largest});
  series.columns.push_back({"Q_of_largest", Role::event, prediction.Q_of_largest});
  return series;
}

std::vector<std::string> warnings_of(const BatchPrediction& prediction) {
  std::vector<std::string> warnings;
  if (prediction.broken.size() == 1) {
    warnings.push_back(
        fmt::format("{} looks broken: with the reading that the other sensors suggest, rows are like those trained on.",
                    prediction.broken.front()));
  } else if (!prediction.broken.empty()) {
    warnings.push_back(fmt::format("{} does not go with the other sensors, or the job is unlike those trained on.",
                                   fmt::join(prediction.broken, " or ")));
  }
  const Extrapolation extrapolation = extrapolation_of(prediction);
  if (extrapolation.matters) {
    warnings.push_back(
        fmt::format("{} of {} rows are farther out than any in training (Hotelling T2), {} unlike all of "
                    "them (Q). There the model extrapolates: its interval is wider, and less to be trusted.",
                    extrapolation.far, prediction.predicted_um.size(), extrapolation.odd));
  }
  const std::vector<BatchPrediction::Outside>& outside = prediction.outside;
  for (std::size_t i = 0; i < std::min(outside.size(), kWarned); ++i) {
    const BatchPrediction::Outside& one = outside[i];
    const std::string_view unit = unit_of(one.what) == "degC" ? "degC" : "K";
    warnings.push_back(
        fmt::format("{} is as far as {:.1f} {} in {} rows from {:.0f} s on; in training {:.1f} to {:.1f}.", one.what,
                    one.value, unit, one.rows, one.time_s, one.low, one.high));
  }
  if (outside.size() > kWarned) warnings.push_back(fmt::format("{} more leave their range.", outside.size() - kWarned));
  return warnings;
}

}  // namespace

std::string stem_of(const std::string& column) { return column.substr(0, column.rfind('_')); }

bool is_batch_model(const Source& model) { return is_batch_model_json(model.head(kHeadBytes)); }

BatchJob batch_job(const Source& data, const Source& model, bool anyway) {
  BatchJob job;
  job.source = data.name() == "-" ? "standard input" : data.name();
  job.model = read_batch_model(model.bytes(kLargestText), model.name());
  job.data = read_data(data);
  job.prediction = with_source(job.source, [&] { return predict(job.model, job.data); });
  if (job.prediction.broken.size() == 1 && !anyway) {
    throw Error(
        fmt::format("{}: expected sensors as in training, found that {} looks broken; put it right, train "
                    "without it (--without-sensor), or predict all the same by --anyway.",
                    job.source, job.prediction.broken.front()));
  }
  job.warnings = warnings_of(job.prediction);
  return job;
}

void predict_batch(const BatchPredictOptions& options) {
  const BatchJob job = batch_job(options.data, options.model, options.anyway);
  const auto& [source, model, data, prediction, warnings] = job;
  const Series series = series_of(model, prediction, data);
  for (const std::string& path : options.out) write_bytes(path, write_series(series));
  if (options.json) {
    print_json(json_of(PredictedJob{{series}, prediction.broken, warnings}), -1);
  } else {
    const auto [low, high] = std::minmax_element(prediction.predicted_um.begin(), prediction.predicted_um.end());
    fmt::print(
        "{}\n{}: {} by {}, {} batches\n\n{} rows over {}: {} from {:.2f} to {:.2f} um, at the end {:.2f} um "
        "±{:.2f} um (95 %)\n",
        source, options.model.name(), model.columns.target, label_of(model.settings), model.batches.size(),
        data.time_s.size(), duration_text(data.time_s.back() - data.time_s.front()), model.columns.target, *low, *high,
        prediction.predicted_um.back(), prediction.half_width_um.back());
    const Column* measured = find_column(data, model.columns.target);
    const auto error = measured == nullptr ? std::nullopt : error_of(prediction, measured->values);
    if (error) {
      fmt::print("measured less predicted: RMSE {:.2f} um, {:.0f} % within the 95 % interval\n", error->rmse_um,
                 100.0 * error->within_share);
    }
    if (!warnings.empty()) fmt::print("\n");
    for (const std::string& warning : warnings) fmt::print("{}", wrapped(warning));
  }
  for (const std::string& path : options.out) wrote_line(path);
}

}  // namespace ballbar

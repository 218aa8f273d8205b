// `ballbar train RUNS --for DATA`: a regression on the recorded batches, weighted by their similarity to the job.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/batch_model_json.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/predict/batch_weights.hpp"
#include "model/model_options.hpp"
#include "predict/predict_results.hpp"
#include "predict/train.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kShownBatches = 16;

std::string conclusion(const TrainedForJob& trained) {
  const BatchChoice &weights = trained.choices.front(), &all = trained.choices.back();
  const auto weighed = std::count_if(trained.ranked.begin(), trained.ranked.end(),
                                     [](const RankedBatch& one) { return one.weight > 0.0; });
  std::string text =
      fmt::format("{} of {} batches, weighted by their similarity to the job (effective number {:.1f}); {}.", weighed,
                  trained.ranked.size(), weights.batches, label_of(weights.settings));
  if (!weights.predicted_rmse_um) return text;
  const double um = *weights.predicted_rmse_um, all_um = *all.predicted_rmse_um;
  text += fmt::format(" They predict the job to {:.2f} um RMSE, all batches to {:.2f} um", um, all_um);
  if (all_um > 0.0) {
    const double less = 100.0 * (1.0 - um / all_um);
    text += fmt::format(": {:.0f} % {}", std::abs(less), less >= 0.0 ? "less" : "more");
  }
  return text + '.';
}

std::string choices_text(const TrainedForJob& trained, double bandwidth) {
  const bool measured = trained.choices.front().predicted_rmse_um.has_value();
  std::vector<std::string> heading{"choice", "batches", "regression"};
  if (measured) heading.emplace_back("RMSE on the job um");
  Table table(heading);
  const auto add = [&](const std::string& label, const BatchChoice& choice, int decimals) {
    std::vector<std::string> row{label, fixed(choice.batches, decimals), label_of(choice.settings)};
    if (measured) row.push_back(fixed(*choice.predicted_rmse_um, 2));
    table.add(row);
  };
  add(std::isfinite(bandwidth) ? fmt::format("weights by similarity, h = {:g}", bandwidth)
                               : "weights by similarity: all equal",
      trained.choices.front(), 1);
  add("all batches", trained.choices.back(), 0);
  return table.text(table_width());
}

std::string ranking_text(const std::vector<RankedBatch>& ranked, bool details) {
  Table table({"batch", "dissimilarity", "weight"});
  for (const RankedBatch& one : ranked) table.add({one.name, fixed(one.distance, 2), fixed(one.weight, 2)});
  if (!details) table.shorten(kShownBatches);
  return table.text(table_width());
}

// What is odd about the job: a sensor that does not go with the others, a room out of all batches' range.
void add_remarks(OpenedBatches& opened, const Batch& job) {
  std::vector<Batch> with_job = opened.batches;
  with_job.push_back(job);
  std::vector<std::string>& remarks = opened.remarks;
  for (const BrokenSensor& broken : broken_sensors(with_job, opened.columns)) {
    if (broken.batches.back() != job.name) continue;
    remarks.push_back(
        fmt::format("{} is off by {:+.1f} K in {}. It looks broken.", broken.sensor, broken.off_K, job.name));
  }
  const auto [coldest, warmest] = std::minmax_element(
      opened.batches.begin(), opened.batches.end(),
      [](const Batch& a, const Batch& b) { return a.start.room_mean_degC < b.start.room_mean_degC; });
  const double low = coldest->start.room_mean_degC, high = warmest->start.room_mean_degC;
  if (job.start.room_first_degC < low || job.start.room_first_degC > high) {
    remarks.push_back(fmt::format(
        "The room temperature of the job is outside the range of all batches, {:.1f} to {:.1f} degC.", low, high));
  }
}

// The job as a batch; without values of the target, where it was not measured throughout, with zeros for them.
Batch job_of(const std::string& name, const BatchColumns& columns, Series job, bool measured) {
  if (!measured) {
    std::erase_if(job.columns, [&](const Column& column) { return column.name == columns.target; });
    job.columns.push_back({columns.target, Role::measured, std::vector<double>(job.time_s.size(), 0.0)});
  }
  return with_source(name, [&] { return batch_of(name, job, columns); });
}

}  // namespace

void train_for_job(const TrainOptions& options) {
  OpenedBatches opened = open_batches(options);
  std::vector<std::filesystem::path> inputs = opened.files;
  if (options.job.is_path()) inputs.push_back(options.job.path());
  if (!options.out.empty()) expect_no_input({options.out}, inputs);
  const Series series = read_batch(options.job, options.max_gap_s, true);
  const Column* target = find_column(series, opened.columns.target);
  const bool measured = target != nullptr && std::all_of(target->values.begin(), target->values.end(),
                                                         [](double um) { return std::isfinite(um); });
  const Batch job = job_of(options.job.name(), opened.columns, series, measured);
  add_remarks(opened, job);
  if (target != nullptr && !measured) {
    opened.remarks.push_back(
        fmt::format("{} has gaps in {}. The prediction is not checked.", opened.columns.target, options.job.name()));
  }
  const RegressionMethod method = options.method.value_or(RegressionMethod::pcr);
  const std::vector<Batch>& batches = opened.batches;
  const BatchWeights weights = with_source(options.title(), [&] { return batch_weights(batches, job.start, method); });
  const auto choice = [&](const char* name, const std::vector<double>& weight, const RegressionSettings& settings) {
    std::optional<double> predicted_rmse_um;
    if (measured) predicted_rmse_um = rmse_um(job.moments, regress(merged(batches, weight), settings));
    return BatchChoice{name, effective_batches(weight), settings, predicted_rmse_um};
  };
  TrainedForJob trained{opened.columns.target,
                        job.start.room_first_degC,
                        {},
                        {choice("weights", weights.weight, weights.settings),
                         choice("all", std::vector(batches.size(), 1.0), best_settings(batches, method))},
                        opened.remarks};
  for (std::size_t k = 0; k < batches.size(); ++k) {
    trained.ranked.push_back({batches[k].name, weights.distance[k], weights.weight[k]});
  }
  std::stable_sort(trained.ranked.begin(), trained.ranked.end(),
                   [](const RankedBatch& a, const RankedBatch& b) { return a.distance < b.distance; });
  if (!options.out.empty()) {
    write_bytes(options.out, write_batch_model(with_source(options.title(), [&] {
                  return temperature_regression(
                      batches, weights.weight, opened.columns, weights.settings,
                      [&](std::size_t k) { return read_batch(options.batch(opened.files[k]), options.max_gap_s); });
                })));
  }
  if (options.json) {
    print_json(json_of(trained));
  } else {
    const std::string heading = fmt::format("{}: room {:.2f} degC at the start; {} batches of {}\n", options.job.name(),
                                            job.start.room_first_degC, batches.size(), options.title());
    fmt::print("{}", on_a_screen({{heading},
                                  {wrapped(conclusion(trained))},
                                  {choices_text(trained, weights.bandwidth)},
                                  {ranking_text(trained.ranked, options.details)},
                                  remarks_part(opened.remarks)},
                                 options.details));
  }
  if (!options.out.empty()) wrote_line(options.out);
}

}  // namespace ballbar

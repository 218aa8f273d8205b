// `ballbar train RUNS --for DATA`: which of the recorded batches to train on for the job at hand.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/batch_model_json.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "model/model_options.hpp"
#include "predict/train.hpp"
#include "predict/training_result.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kShownBatches = 16;

// What a rule is called.
std::string rule_text(const BatchChoice& choice, const BatchRanking& ranking, double fall) {
  switch (choice.take) {
    case Take::paper:
      return fmt::format("{} of RMSE_m by {:g} %{}", ranking.paper_found ? "the first fall" : "no fall", 100.0 * fall,
                         ranking.paper_found ? "" : ": all");
    case Take::held_out:
      return "best for batches like this";
    case Take::weights:
      return std::isfinite(ranking.bandwidth) ? fmt::format("weights by similarity, h = {:g}", ranking.bandwidth)
                                              : "weights by similarity: all equal";
    default:
      return "all batches";
  }
}

std::string names_of(const BatchRanking& ranking, std::size_t number) {
  constexpr std::size_t kNamed = 8;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(number, kNamed); ++i) names.push_back(ranking.ranked[i].name);
  return fmt::format("{}{}", fmt::join(names, " "), number > kNamed ? " ..." : "");
}

std::string conclusion(const BatchRanking& ranking, const BatchChoice& taken,
                       const std::optional<RandomChoices>& random) {
  const std::size_t all = ranking.ranked.size();
  std::string text;
  if (taken.take == Take::weights) {
    text = fmt::format("{} of {} batches, weighted by their similarity to the job (effective number {:.1f})",
                       taken.batches, all, effective_batches(taken.weights));
  } else if (taken.batches == all) {
    text = fmt::format("All {} batches", all);
  } else {
    text = fmt::format("{} of {} batches: {}", taken.batches, all, names_of(ranking, taken.batches));
  }
  text += fmt::format("; {}.", label_of(taken.settings));
  if (!taken.predicted_rmse_um) return text;
  const double um = *taken.predicted_rmse_um, all_um = *ranking.choice(Take::all).predicted_rmse_um;
  text += fmt::format(" They predict the job to {:.2f} um RMSE, all batches to {:.2f} um", um, all_um);
  if (taken.take != Take::all && all_um > 0.0) {
    const double less = 100.0 * (1.0 - um / all_um);
    text += fmt::format(": {:.0f} % {}", std::abs(less), less >= 0.0 ? "less" : "more");
  }
  if (random) {
    text += fmt::format("; {:.0f} of {} random choices of {} batches do worse",
                        random->share_worse * static_cast<double>(random->predicted_rmse_um.size()),
                        random->predicted_rmse_um.size(), random->batches);
  }
  return text + '.';
}

std::string choices_text(const BatchRanking& ranking, double fall, const std::optional<RandomChoices>& random) {
  const std::optional<double>& all_um = ranking.choice(Take::all).predicted_rmse_um;
  std::vector<std::string> heading{"choice", "batches", "regression"};
  if (all_um) heading.insert(heading.end(), {"RMSE_p um", "less than all"});
  Table table(heading);
  const auto less = [&](double um) {
    return *all_um > 0.0 ? fmt::format("{} %", fixed(100.0 * (1.0 - um / *all_um), 0)) : "-";
  };
  for (const BatchChoice& choice : ranking.choices) {
    std::vector<std::string> row{rule_text(choice, ranking, fall),
                                 fixed(effective_batches(choice.weights), choice.take == Take::weights ? 1 : 0),
                                 label_of(choice.settings)};
    if (all_um) row.insert(row.end(), {fixed(*choice.predicted_rmse_um, 2), less(*choice.predicted_rmse_um)});
    table.add(row);
  }
  if (random) {
    const std::vector<double>& um = random->predicted_rmse_um;
    const auto add = [&](const std::string& label, double share) {
      const double one = um[static_cast<std::size_t>(share * static_cast<double>(um.size() - 1))];
      table.add({label, fmt::format("{}", random->batches), "", fixed(one, 2), less(one)});
    };
    add(fmt::format("{} random choices, median", um.size()), 0.5);
    add("their best tenth", 0.1);
    add("their worst tenth", 0.9);
  }
  return table.text(table_width());
}

std::string ranking_text(const std::vector<RankedBatch>& ranked, bool details) {
  const bool measured = ranked.front().predicted_rmse_um.has_value();
  std::vector<std::string> heading{"batch", "rank", "room difference K", "dissimilarity", "weight", "RMSE_m um"};
  if (measured) heading.emplace_back("RMSE_p um");
  Table table(heading);
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const RankedBatch& one = ranked[i];
    std::vector<std::string> row{one.name,
                                 fmt::format("{}", i + 1),
                                 fixed(one.room_apart_K, 2),
                                 fixed(one.distance, 2),
                                 fixed(one.weight, 2),
                                 fixed(one.modelling_rmse_um, 2)};
    if (measured) row.push_back(fixed(*one.predicted_rmse_um, 2));
    table.add(row);
  }
  if (!details) table.shorten(kShownBatches);
  return table.text(table_width()) + fmt::format("RMSE_m: residual of a regression on the batches up to this rank{}.\n",
                                                 measured ? "; RMSE_p: its error on the job" : "");
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
  const Series series = read_batch(options.job, true);
  const Column* target = find_column(series, opened.columns.target);
  const bool measured = target != nullptr && std::all_of(target->values.begin(), target->values.end(),
                                                         [](double um) { return std::isfinite(um); });
  const Batch job = job_of(options.job.name(), opened.columns, series, measured);
  add_remarks(opened, job);
  if (target != nullptr && !measured) {
    opened.remarks.push_back(
        fmt::format("{} has gaps in {}. The prediction is not checked.", opened.columns.target, options.job.name()));
  }
  const ChoiceOptions how{options.method.value_or(RegressionMethod::pcr), options.share, options.fall};
  const BatchRanking ranking = with_source(options.title(), [&] {
    return batch_ranking(opened.batches, job.start, measured ? &job.moments : nullptr, how);
  });
  const BatchChoice& taken = ranking.choice(options.take);
  std::optional<RandomChoices> random;
  const auto count = static_cast<std::size_t>(std::lround(effective_batches(taken.weights)));
  if (measured && options.random.choices > 0 && count < opened.batches.size()) {
    random = random_choices(opened.batches, job.moments, taken, taken.take == Take::weights ? std::nullopt : how.share,
                            options.random);
  }
  if (!options.out.empty()) {
    write_bytes(options.out, write_batch_model(with_source(options.title(), [&] {
                  return temperature_regression(
                      opened.batches, taken.weights, opened.columns, taken.settings,
                      [&](std::size_t k) { return read_batch(options.batch(opened.files[k])); });
                })));
  }
  if (options.json) {
    print_json(json_of(
        TrainedForJob{opened.columns.target, job.start.room_first_degC, taken.take, ranking, random, opened.remarks}));
  } else {
    const std::string heading = fmt::format("{}: room {:.2f} degC at the start; {} batches of {}\n", options.job.name(),
                                            job.start.room_first_degC, opened.batches.size(), options.title());
    fmt::print("{}", on_a_screen({{heading},
                                  {wrapped(conclusion(ranking, taken, random))},
                                  {choices_text(ranking, options.fall, random)},
                                  {ranking_text(ranking.ranked, options.details)},
                                  remarks_part(opened.remarks)},
                                 options.details));
  }
  if (!options.out.empty()) wrote_line(options.out);
}

}  // namespace ballbar

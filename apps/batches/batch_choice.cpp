#include "batches/batch_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/batch_model_json.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "batches/batches.hpp"
#include "batches/select_result.hpp"
#include "model/model_options.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kShown = 30;  // batches

// One way to choose, with what came of it.
struct Choice {
  std::string key, label;
  std::vector<double> weights;  // of the batches
  RegressionSettings settings;
  std::optional<double> rmse_um;  // of prediction
};

// Random choices of as many batches as the choice that is taken.
struct Compared {
  std::size_t batches = 0;
  RandomChoices found;
};

std::vector<double> first(const Selection& selection, std::size_t number) {
  std::vector<double> weights(selection.ranked.size(), 0.0);
  for (std::size_t i = 0; i < number; ++i) weights[selection.ranked[i].batch] = 1.0;
  return weights;
}

// In the order of Take.
std::vector<Choice> choices_of(const Selection& selection, const SelectionOptions& options) {
  const auto settings = [&](std::size_t number) { return selection.ranked[number - 1].settings; };
  const std::string by_paper = selection.paper_found
                                   ? fmt::format("the first fall of RMSE_m by {:g} %", 100.0 * options.fall)
                                   : fmt::format("no fall of RMSE_m by {:g} %: all", 100.0 * options.fall);
  const std::string by_weights = std::isfinite(selection.bandwidth)
                                     ? fmt::format("weights by likeness, h = {:g}", selection.bandwidth)
                                     : "weights by likeness: all alike";
  return {{"paper", by_paper, first(selection, selection.by_paper), settings(selection.by_paper), selection.paper_um},
          {"held_out", "best for batches like this", first(selection, selection.by_held_out),
           settings(selection.by_held_out), selection.held_out_rmse_um},
          {"weights", by_weights, weights_of(selection), selection.weights_settings, selection.weights_um},
          {"all", "all batches", first(selection, selection.ranked.size()), settings(selection.ranked.size()),
           selection.all_um}};
}

std::string names_of(const std::vector<Batch>& batches, const Selection& selection, std::size_t number) {
  constexpr std::size_t kNamed = 8;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(number, kNamed); ++i) {
    names.push_back(batches[selection.ranked[i].batch].name);
  }
  return fmt::format("{}{}", fmt::join(names, " "), number > kNamed ? " ..." : "");
}

std::string conclusion(const ChoiceOptions& options, const OpenedBatches& opened, const Selection& selection,
                       const std::vector<Choice>& choices, const std::optional<Compared>& random) {
  const auto take = static_cast<Take>(options.take);
  const Choice& taken = choices[options.take];
  std::string text;
  if (take == Take::weights) {
    const auto used = std::count_if(taken.weights.begin(), taken.weights.end(), [](double w) { return w > 0.0; });
    text = fmt::format("{} of {} batches, weighed by their likeness to the job (as many as {:.1f} alike)", used,
                       opened.batches.size(), effective_batches(taken.weights));
  } else {
    const std::size_t number = take == Take::paper      ? selection.by_paper
                               : take == Take::held_out ? selection.by_held_out
                                                        : opened.batches.size();
    text = number == opened.batches.size() ? fmt::format("All {} batches", number)
                                           : fmt::format("{} of {} batches: {}", number, opened.batches.size(),
                                                         names_of(opened.batches, selection, number));
  }
  text += fmt::format("; {}.", label_of(taken.settings));
  if (taken.rmse_um) {
    text += fmt::format(" They predict the job to {:.2f} um RMSE, all batches to {:.2f} um", *taken.rmse_um,
                        *selection.all_um);
    if (take != Take::all && *selection.all_um > 0.0) {
      const double less = 100.0 * (1.0 - *taken.rmse_um / *selection.all_um);
      text += fmt::format(": {:.0f} % {}", std::abs(less), less >= 0.0 ? "less" : "more");
    }
    if (random) {
      text += fmt::format("; {:.0f} of {} random choices of {} batches do worse",
                          random->found.share_worse * static_cast<double>(random->found.predicted_rmse_um.size()),
                          random->found.predicted_rmse_um.size(), random->batches);
    }
    text += '.';
  }
  return text;
}

void print_choices(const std::vector<Choice>& choices, const Selection& selection,
                   const std::optional<Compared>& random) {
  const bool measured = selection.all_um.has_value();
  std::vector<std::string> heading{"choice", "batches", "regression"};
  if (measured) heading.insert(heading.end(), {"RMSE_p um", "less than all"});
  Table table(heading);
  const auto less = [&](double um) {
    return *selection.all_um > 0.0 ? fmt::format("{} %", fixed(100.0 * (1.0 - um / *selection.all_um), 0)) : "-";
  };
  for (const Choice& choice : choices) {
    const double count = effective_batches(choice.weights);
    std::vector<std::string> row{choice.label, fixed(count, choice.key == "weights" ? 1 : 0),
                                 label_of(choice.settings)};
    if (measured) row.insert(row.end(), {fixed(*choice.rmse_um, 2), less(*choice.rmse_um)});
    table.add(row);
  }
  if (random) {
    const std::vector<double>& um = random->found.predicted_rmse_um;
    const auto add = [&](const std::string& label, double share) {
      const double one = um[static_cast<std::size_t>(share * static_cast<double>(um.size() - 1))];
      table.add({label, fmt::format("{}", random->batches), "", fixed(one, 2), less(one)});
    };
    add(fmt::format("{} random choices, median", um.size()), 0.5);
    add("their best tenth", 0.1);
    add("their worst tenth", 0.9);
  }
  fmt::print("\n{}", table.text(table_width()));
}

void print_ranking(const ChoiceOptions& options, const OpenedBatches& opened, const Selection& selection,
                   bool measured) {
  std::vector<std::string> heading{"batch", "rank", "room apart K", "unlike", "weight", "RMSE_m um"};
  if (measured) heading.emplace_back("RMSE_p um");
  Table table(heading);
  const std::size_t shown = options.every ? selection.ranked.size() : std::min(selection.ranked.size(), kShown);
  for (std::size_t i = 0; i < shown; ++i) {
    const RankedBatch& one = selection.ranked[i];
    std::vector<std::string> row{opened.batches[one.batch].name, fmt::format("{}", i + 1),
                                 fixed(one.room_apart_K, 2),     fixed(one.distance, 2),
                                 fixed(one.weight, 2),           fixed(one.modelling_rmse_um, 2)};
    if (measured) row.push_back(fixed(*one.predicted_rmse_um, 2));
    table.add(row);
  }
  fmt::print("\n{}", table.text(table_width()));
  if (shown < selection.ranked.size()) fmt::print("{} more (--every)\n", selection.ranked.size() - shown);
  fmt::print("RMSE_m: of the batches up to this rank by a regression to them{}.\n",
             measured ? "; RMSE_p: of the job by it" : "");
}

SelectedBatches result_of(const ChoiceOptions& options, const OpenedBatches& opened, const Selection& selection,
                          const std::vector<Choice>& choices, const std::optional<Compared>& random,
                          const BatchStart& job) {
  SelectedBatches result{opened.columns.target, job.room_first_degC, choices[options.take].key, {}, {}, {},
                         std::nullopt,          opened.remarks};
  for (const RankedBatch& one : selection.ranked) result.ranked.push_back({opened.batches[one.batch].name, one});
  for (const Choice& choice : choices)
    result.choices.push_back({choice.key, effective_batches(choice.weights), choice.settings, choice.rmse_um});
  for (const auto& [count, um] : selection.held_out_um) result.held_out.push_back({count, um});
  if (random) result.random = {random->batches, random->found};
  return result;
}

// What is odd about the job: a sensor that does not go with the others, a room out of all batches' range.
void add_remarks(const ChoiceOptions& options, const OpenedBatches& opened, const Batch& job,
                 std::vector<std::string>& remarks) {
  std::vector<Batch> with_job = opened.batches;
  with_job.push_back(job);
  for (const BrokenSensor& broken : broken_sensors(with_job, opened.columns)) {
    if (broken.batches.back() != job.name) continue;
    remarks.push_back(
        fmt::format("{} is off by {:+.1f} K in {}: it looks broken.", broken.sensor, broken.off_K, options.job.name()));
  }
  const auto [coldest, warmest] = std::minmax_element(
      opened.batches.begin(), opened.batches.end(),
      [](const Batch& a, const Batch& b) { return a.start.room_mean_degC < b.start.room_mean_degC; });
  const double low = coldest->start.room_mean_degC, high = warmest->start.room_mean_degC;
  if (job.start.room_first_degC < low || job.start.room_first_degC > high) {
    remarks.push_back(
        fmt::format("The room of the job is outside that of all batches, {:.1f} to {:.1f} degC.", low, high));
  }
}

// The job as a batch; without values of the target, where it was not measured throughout, with zeros for them.
Batch job_of(const ChoiceOptions& options, const BatchColumns& columns, Series job, bool measured) {
  if (!measured) {
    std::erase_if(job.columns, [&](const Column& column) { return column.name == columns.target; });
    job.columns.push_back({columns.target, Role::measured, std::vector<double>(job.time_s.size(), 0.0)});
  }
  return with_source(options.job.name(), [&] { return batch_of(options.job.name(), job, columns); });
}

}  // namespace

void choose_batches(ChoiceOptions options) {
  options.batches.job = options.job;
  OpenedBatches opened = open_batches(options.batches);
  std::vector<std::filesystem::path> inputs = opened.files;
  if (options.job.is_path()) inputs.push_back(options.job.path());
  if (!options.out.empty()) expect_no_input({options.out}, inputs);
  const Series job = read_batch(options.job);
  const Column* target = find_column(job, opened.columns.target);
  const bool measured = target != nullptr && std::all_of(target->values.begin(), target->values.end(),
                                                         [](double um) { return std::isfinite(um); });
  const Batch as_batch = job_of(options, opened.columns, job, measured);
  const BatchStart& start = as_batch.start;
  const std::optional<Moments> moments = measured ? std::optional(as_batch.moments) : std::nullopt;
  add_remarks(options, opened, as_batch, opened.remarks);
  if (target != nullptr && !measured) {
    opened.remarks.push_back(fmt::format("{} has gaps in {}: what is predicted for it is not checked.",
                                         opened.columns.target, options.job.name()));
  }
  SelectionOptions how = options.selection;
  how.method = static_cast<RegressionMethod>(options.method.value_or(0));
  const Selection selection = with_source(options.batches.list.name(), [&] {
    return select_batches(opened.batches, start, moments ? &*moments : nullptr, how);
  });
  const std::vector<Choice> choices = choices_of(selection, how);
  const Choice& taken = choices[options.take];
  std::optional<Compared> random;
  const auto count = static_cast<std::size_t>(std::lround(effective_batches(taken.weights)));
  if (measured && options.random.choices > 0 && count < opened.batches.size()) {
    RandomOptions chance = options.random;
    chance.batches = count;
    const std::optional<double> share =
        options.take == static_cast<std::size_t>(Take::weights) ? std::nullopt : how.share;
    random = Compared{count, random_choices(opened.batches, *moments, taken.settings, share, *taken.rmse_um, chance)};
  }
  if (!options.out.empty()) {
    write_bytes(options.out, write_batch_model(with_source(options.batches.list.name(), [&] {
                  return trained(opened.batches, taken.weights, opened.columns, taken.settings,
                                 [&](std::size_t k) { return read_batch(opened.files[k]); });
                })));
  }
  if (options.json) {
    print_json(json_of(result_of(options, opened, selection, choices, random, start)));
  } else {
    fmt::print("{}: room {:.2f} degC as it begins; {} batches of {}\n\n{}", options.job.name(), start.room_first_degC,
               opened.batches.size(), options.batches.list.name(),
               wrapped(conclusion(options, opened, selection, choices, random)));
    print_choices(choices, selection, random);
    print_ranking(options, opened, selection, measured);
    if (!opened.remarks.empty()) fmt::print("\n");
    for (const std::string& remark : opened.remarks) fmt::print("{}", wrapped(remark));
  }
  if (!options.out.empty()) wrote_line(options.out);
}

}  // namespace ballbar

// What `train --for --json` prints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/batches/batch_selection.hpp"
#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

struct NamedBatch {
  std::string name;
  RankedBatch ranked;
};

template <>
struct ResultType<NamedBatch> {
  static constexpr std::string_view name = "RankedBatch";
  static constexpr std::string_view meaning = "A batch, and how like the job it is.";
  static constexpr std::tuple likeness{
      Field{"room_apart_K", &RankedBatch::room_apart_K, "temperature of the room as it begins"},
      Field{"distance", &RankedBatch::distance, "how unlike it is"},
      Field{"weight", &RankedBatch::weight, ""},
      Field{"components", [](const RankedBatch& of) { return of.settings.components; }, "of the regression up to it"},
      Field{"modelling_rmse_um", &RankedBatch::modelling_rmse_um, "of the batches up to this rank"},
      Field{"predicted_rmse_um", &RankedBatch::predicted_rmse_um, "of the job by these; null: not measured"}};
  static constexpr std::tuple fields =
      std::tuple_cat(std::tuple{Field{"batch", &NamedBatch::name, ""}}, fields_through(&NamedBatch::ranked, likeness));
};

struct BatchChoice {
  std::string choice;
  double batches = 0.0;
  RegressionSettings settings;
  std::optional<double> predicted_rmse_um;
};

template <>
struct ResultType<BatchChoice> {
  using Of = const BatchChoice&;
  static constexpr std::string_view name = "BatchChoice";
  static constexpr std::string_view meaning = "A way to choose batches.";
  static constexpr std::tuple fields{
      Field{"choice", &BatchChoice::choice, "paper, held_out, weights, all"},
      Field{"batches", &BatchChoice::batches, "as many as these alike"},
      Field{"method", [](Of of) { return of.settings.method; }, "pcr, ridge, ..."},
      Field{"components", [](Of of) { return of.settings.components; }, ""},
      Field{"penalty_K2", [](Of of) { return of.settings.penalty_K2; }, "of ridge"},
      Field{"predicted_rmse_um", &BatchChoice::predicted_rmse_um, "of the job; null: not measured"}};
};

struct HeldOutBatches {
  std::size_t batches = 0;
  double rmse_um = 0.0;
};

template <>
struct ResultType<HeldOutBatches> {
  static constexpr std::string_view name = "HeldOutBatches";
  static constexpr std::string_view meaning = "Error of batches like the job by so many batches.";
  static constexpr std::tuple fields{Field{"batches", &HeldOutBatches::batches, "how many"},
                                     Field{"rmse_um", &HeldOutBatches::rmse_um, ""}};
};

struct RandomBatches {
  std::size_t batches = 0;
  RandomChoices found;
};

template <>
struct ResultType<RandomBatches> {
  using Of = const RandomBatches&;
  static constexpr std::string_view name = "RandomBatches";
  static constexpr std::string_view meaning = "Random choices of as many batches as are taken.";
  static constexpr std::tuple fields{
      Field{"batches", &RandomBatches::batches, "in each"},
      Field{"share_worse", [](Of of) { return of.found.share_worse; }, "than what is taken"},
      Field{"predicted_rmse_um", [](Of of) { return of.found.predicted_rmse_um; }, "of the job, rising"}};
};

struct SelectedBatches {
  std::string target;
  double room_degC = 0.0;
  std::string taken;
  std::vector<NamedBatch> ranked;
  std::vector<BatchChoice> choices;
  std::vector<HeldOutBatches> held_out;
  std::optional<RandomBatches> random;
  std::vector<std::string> remarks;
};

template <>
struct ResultType<SelectedBatches> {
  static constexpr std::string_view name = "Selected";
  static constexpr std::string_view meaning = "Batches to train on for a job.";
  static constexpr std::tuple fields{
      Field{"target", &SelectedBatches::target, "column that is predicted"},
      Field{"room_degC", &SelectedBatches::room_degC, "as the job begins"},
      Field{"taken", &SelectedBatches::taken, "the choice that is written"},
      Field{"ranked", &SelectedBatches::ranked, "batches by the temperature of their rooms"},
      Field{"choices", &SelectedBatches::choices, "with what came of each"},
      Field{"held_out", &SelectedBatches::held_out, "by number of batches"},
      Field{"random", &SelectedBatches::random, "choices to compare with; null: none"},
      Field{"remarks", &SelectedBatches::remarks, ""}};
};

}  // namespace ballbar

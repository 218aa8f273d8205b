// What `train --json` prints of a regression on temperatures, and of batches chosen for a job.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/predict/batch_choice.hpp"
#include "predict/train.hpp"

namespace ballbar {

inline constexpr std::tuple kContenderErrors{
    Field{"held_out_um", [](const Contender& of) { return of.held_out.rms_um; }, "RMSE of batches left out"},
    Field{"worst_um", [](const Contender& of) { return of.held_out.worst_um; }, "of the worst of them"},
    Field{"worst_batch", &Contender::worst, ""}, Field{"rmse_um", &Contender::rmse_um, "of all batches, trained on"}};

template <>
struct ResultType<Contender> {
  using Of = const Contender&;
  static constexpr std::string_view name = "TrainedMethod";
  static constexpr std::string_view meaning = "A method of regression.";
  static constexpr std::tuple fields =
      std::tuple_cat(std::tuple{Field{"method", [](Of of) { return of.settings.method; }, "pcr, ridge"},
                                Field{"components", [](Of of) { return of.settings.components; }, ""},
                                Field{"penalty_K2", [](Of of) { return of.settings.penalty_K2; }, "of ridge"}},
                     kContenderErrors, std::tuple{Field{"taken", &Contender::taken, "whether it is written"}});
};

struct ComparedModel {
  Contender contender;
};

template <>
struct ResultType<ComparedModel> {
  static constexpr std::string_view name = "ComparedModel";
  static constexpr std::string_view meaning = "A model of effects in the same contest.";
  static constexpr std::tuple fields =
      fields_through(&ComparedModel::contender,
                     std::tuple_cat(std::tuple{Field{"model", &Contender::label, "file"}}, kContenderErrors));
};

struct TrainedOnTemperatures {
  std::string target;
  std::size_t batches = 0;
  double held_out_um = 0.0, half_width_um = 0.0;
  std::vector<Contender> methods;
  MayLack<ComparedModel> effects;
  std::vector<std::string> remarks;
};

template <>
struct ResultType<TrainedOnTemperatures> {
  using Of = TrainedOnTemperatures;
  static constexpr std::string_view name = "Trained";
  static constexpr std::string_view meaning = "A regression on temperatures over batches.";
  static constexpr std::tuple fields{
      Field{"target", &Of::target, "column that is predicted"},
      Field{"batches", &Of::batches, "how many"},
      Field{"held_out_um", &Of::held_out_um, "RMSE on what was left out"},
      Field{"half_width_um", &Of::half_width_um, "of the interval of 95 %"},
      Field{"methods", &Of::methods, "that were compared"},
      Field{"effects", &Of::effects, "with --model: a model of effects in the same contest"},
      Field{"remarks", &Of::remarks, ""}};
};

template <>
struct ResultType<RankedBatch> {
  static constexpr std::string_view name = "RankedBatch";
  static constexpr std::string_view meaning = "A batch, and how like the job it is.";
  static constexpr std::tuple fields{
      Field{"batch", &RankedBatch::name, ""},
      Field{"room_apart_K", &RankedBatch::room_apart_K, "temperature of the room as it begins"},
      Field{"distance", &RankedBatch::distance, "how unlike it is"},
      Field{"weight", &RankedBatch::weight, ""},
      Field{"components", [](const RankedBatch& of) { return of.settings.components; }, "of the regression up to it"},
      Field{"modelling_rmse_um", &RankedBatch::modelling_rmse_um, "of the batches up to this rank"},
      Field{"predicted_rmse_um", &RankedBatch::predicted_rmse_um, "of the job by these; null: not measured"}};
};

template <>
struct ResultType<BatchChoice> {
  using Of = const BatchChoice&;
  static constexpr std::string_view name = "BatchChoice";
  static constexpr std::string_view meaning = "A way to choose batches.";
  static constexpr std::tuple fields{
      Field{"choice", &BatchChoice::take, "paper, held_out, weights, all"},
      Field{"batches", [](Of of) { return effective_batches(of.weights); }, "as many as these alike"},
      Field{"method", [](Of of) { return of.settings.method; }, "pcr, ridge"},
      Field{"components", [](Of of) { return of.settings.components; }, ""},
      Field{"penalty_K2", [](Of of) { return of.settings.penalty_K2; }, "of ridge"},
      Field{"predicted_rmse_um", &BatchChoice::predicted_rmse_um, "of the job; null: not measured"}};
};

template <>
struct ResultType<HeldOutNumber> {
  static constexpr std::string_view name = "HeldOutBatches";
  static constexpr std::string_view meaning = "Error of batches like the job by so many batches.";
  static constexpr std::tuple fields{Field{"batches", &HeldOutNumber::batches, "how many"},
                                     Field{"rmse_um", &HeldOutNumber::rmse_um, ""}};
};

template <>
struct ResultType<RandomChoices> {
  static constexpr std::string_view name = "RandomBatches";
  static constexpr std::string_view meaning = "Random choices of as many batches as are taken.";
  static constexpr std::tuple fields{
      Field{"batches", &RandomChoices::batches, "in each"},
      Field{"share_worse", &RandomChoices::share_worse, "than what is taken"},
      Field{"predicted_rmse_um", &RandomChoices::predicted_rmse_um, "of the job, rising"}};
};

struct TrainedForJob {
  std::string target;
  double room_degC = 0.0;
  Take taken = Take::weights;
  BatchRanking ranking;
  std::optional<RandomChoices> random;
  std::vector<std::string> remarks;
};

template <>
struct ResultType<TrainedForJob> {
  using Of = const TrainedForJob&;
  static constexpr std::string_view name = "Selected";
  static constexpr std::string_view meaning = "Batches to train on for a job.";
  static constexpr std::tuple fields{
      Field{"target", &TrainedForJob::target, "column that is predicted"},
      Field{"room_degC", &TrainedForJob::room_degC, "as the job begins"},
      Field{"taken", &TrainedForJob::taken, "the choice that is written"},
      Field{"ranked", [](Of of) { return of.ranking.ranked; }, "batches by the temperature of their rooms"},
      Field{"choices", [](Of of) { return std::vector(of.ranking.choices.begin(), of.ranking.choices.end()); },
            "with what came of each"},
      Field{"held_out", [](Of of) { return of.ranking.held_out; }, "by number of batches"},
      Field{"random", &TrainedForJob::random, "choices to compare with; null: none"},
      Field{"remarks", &TrainedForJob::remarks, ""}};
};

}  // namespace ballbar

// What `train --json` prints of a regression on temperatures, and of batches weighted for a job.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "predict/train.hpp"

namespace ballbar {

inline constexpr std::tuple kRegressionSettings{Field{"method", &RegressionSettings::method, "pcr, ridge"},
                                                Field{"components", &RegressionSettings::components, ""},
                                                Field{"penalty_K2", &RegressionSettings::penalty_K2, "of ridge"}};

inline constexpr std::tuple kContenderErrors{
    Field{"held_out_um", [](const Contender& of) { return of.held_out.rms_um; }, "RMSE of batches left out"},
    Field{"worst_um", [](const Contender& of) { return of.held_out.worst_um; }, "of the worst of them"},
    Field{"worst_batch", &Contender::worst, ""}, Field{"rmse_um", &Contender::rmse_um, "of all batches, trained on"}};

template <>
struct ResultType<Contender> {
  static constexpr std::string_view name = "TrainedMethod";
  static constexpr std::string_view meaning = "A method of regression.";
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&Contender::settings, kRegressionSettings), kContenderErrors,
                     std::tuple{Field{"taken", &Contender::taken, "whether it is written"}});
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

struct RankedBatch {
  std::string name;
  double distance = 0.0, weight = 0.0;
};

template <>
struct ResultType<RankedBatch> {
  static constexpr std::string_view name = "RankedBatch";
  static constexpr std::string_view meaning = "A batch, and how like the job it is.";
  static constexpr std::tuple fields{Field{"batch", &RankedBatch::name, ""},
                                     Field{"distance", &RankedBatch::distance, "how unlike it is"},
                                     Field{"weight", &RankedBatch::weight, ""}};
};

struct BatchChoice {
  std::string name;
  double batches = 0.0;
  RegressionSettings settings;
  std::optional<double> predicted_rmse_um;
};

template <>
struct ResultType<BatchChoice> {
  static constexpr std::string_view name = "BatchChoice";
  static constexpr std::string_view meaning = "A way to choose batches.";
  static constexpr std::tuple fields = std::tuple_cat(
      std::tuple{Field{"choice", &BatchChoice::name, "weights, all"},
                 Field{"batches", &BatchChoice::batches, "as many as these alike"}},
      fields_through(&BatchChoice::settings, kRegressionSettings),
      std::tuple{Field{"predicted_rmse_um", &BatchChoice::predicted_rmse_um, "of the job; null: not measured"}});
};

struct TrainedForJob {
  std::string target;
  double room_degC = 0.0;
  std::vector<RankedBatch> ranked;
  std::vector<BatchChoice> choices;  // by weights, and all
  std::vector<std::string> remarks;
};

template <>
struct ResultType<TrainedForJob> {
  static constexpr std::string_view name = "Selected";
  static constexpr std::string_view meaning = "Batches to train on for a job.";
  static constexpr std::tuple fields{Field{"target", &TrainedForJob::target, "column that is predicted"},
                                     Field{"room_degC", &TrainedForJob::room_degC, "as the job begins"},
                                     Field{"ranked", &TrainedForJob::ranked, "batches, the most like the job first"},
                                     Field{"choices", &TrainedForJob::choices, "with what came of each"},
                                     Field{"remarks", &TrainedForJob::remarks, ""}};
};

}  // namespace ballbar

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
inline constexpr auto kResult<Contender> =
    ResultType{"TrainedMethod", "A method of regression.",
               std::tuple_cat(fields_through(&Contender::settings, kRegressionSettings), kContenderErrors,
                              std::tuple{Field{"taken", &Contender::taken, "whether it is written"}})};

struct ComparedModel {
  Contender contender;
};

template <>
inline constexpr auto kResult<ComparedModel> =
    ResultType{"ComparedModel", "A model of effects in the same contest.",
               fields_through(&ComparedModel::contender,
                              std::tuple_cat(std::tuple{Field{"model", &Contender::label, "file"}}, kContenderErrors))};

struct TrainedOnTemperatures {
  std::string target;
  std::size_t batches = 0;
  double held_out_um = 0.0, half_width_um = 0.0;
  std::vector<Contender> methods;
  MayLack<ComparedModel> effects;
  std::vector<std::string> remarks;
};

template <>
inline constexpr auto kResult<TrainedOnTemperatures> =
    ResultType{"Trained", "A regression on temperatures over batches.",
               std::tuple{Field{"target", &TrainedOnTemperatures::target, "column that is predicted"},
                          Field{"batches", &TrainedOnTemperatures::batches, "how many"},
                          Field{"held_out_um", &TrainedOnTemperatures::held_out_um, "RMSE on what was left out"},
                          Field{"half_width_um", &TrainedOnTemperatures::half_width_um, "of the interval of 95 %"},
                          Field{"methods", &TrainedOnTemperatures::methods, "that were compared"},
                          Field{"effects", &TrainedOnTemperatures::effects,
                                "with --model: a model of effects in the same contest"},
                          Field{"remarks", &TrainedOnTemperatures::remarks, ""}}};

struct RankedBatch {
  std::string name;
  double distance = 0.0, weight = 0.0;
};

template <>
inline constexpr auto kResult<RankedBatch> = ResultType{
    "RankedBatch", "A batch, and how like the job it is.",
    std::tuple{Field{"batch", &RankedBatch::name, ""}, Field{"distance", &RankedBatch::distance, "how unlike it is"},
               Field{"weight", &RankedBatch::weight, ""}}};

struct BatchChoice {
  std::string name;
  double batches = 0.0;
  RegressionSettings settings;
  std::optional<double> predicted_rmse_um;
};

template <>
inline constexpr auto kResult<BatchChoice> = ResultType{
    "BatchChoice", "A way to choose batches.",
    std::tuple_cat(
        std::tuple{Field{"choice", &BatchChoice::name, "weights, all"},
                   Field{"batches", &BatchChoice::batches, "as many as these alike"}},
        fields_through(&BatchChoice::settings, kRegressionSettings),
        std::tuple{Field{"predicted_rmse_um", &BatchChoice::predicted_rmse_um, "of the job; null: not measured"}})};

struct TrainedForJob {
  std::string target;
  double room_degC = 0.0;
  std::vector<RankedBatch> ranked;
  std::vector<BatchChoice> choices;  // by weights, and all
  std::vector<std::string> remarks;
};

template <>
inline constexpr auto kResult<TrainedForJob> =
    ResultType{"Selected", "Batches to train on for a job.",
               std::tuple{Field{"target", &TrainedForJob::target, "column that is predicted"},
                          Field{"room_degC", &TrainedForJob::room_degC, "as the job begins"},
                          Field{"ranked", &TrainedForJob::ranked, "batches, the most like the job first"},
                          Field{"choices", &TrainedForJob::choices, "with what came of each"},
                          Field{"remarks", &TrainedForJob::remarks, ""}}};

}  // namespace ballbar

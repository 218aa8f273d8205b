// What `predict --json` and `train --json` print.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/predict/predict.hpp"
#include "ballbar/predict/train.hpp"
#include "ballbar/series/series.hpp"
#include "model/column_fault_text.hpp"
#include "predict/train.hpp"

namespace ballbar {

// Of `predict`.

template <>
inline constexpr auto kResult<DriverShare> =
    ResultType("DriverShare", "How much of what is predicted goes with a column.",
               Field{"column", &DriverShare::column}, Field{"role", &DriverShare::role, "as of a series"},
               Field{"share_um", &DriverShare::share_um, "of the range of what is predicted"});

template <>
inline constexpr auto kResult<Series> =
    ResultType("Predicted", "A model's series.", Field{"time_s", &Series::time_s, "of each row"},
               Field{"COLUMN",
                     [](const Series& of) {
                       KeysOf<std::vector<double>> columns;
                       for (const Column& column : of.columns) columns.values.emplace_back(column.name, column.values);
                       return columns;
                     },
                     "TARGET_model_um, the target, TARGET_residual_um, and what each effect adds"});

template <>
inline constexpr auto kResult<PredictionError> =
    ResultType("PredictionError", "Measured less predicted, of rows that are new.",
               Field{"rows", &PredictionError::rows, "how many"},
               Field{"mean_um", &PredictionError::mean_um, "mean of the absolute error"},
               Field{"rmse_um", &PredictionError::rmse_um},
               Field{"within_share", &PredictionError::within_share, "within the interval of 95 %"});

struct PredictedTarget {
  Series predicted;
  std::optional<bool> goes_on, holds;
  std::optional<std::vector<DriverShare>> drivers;
  std::optional<PredictionError> error;
  std::optional<std::vector<std::string>> broken;
  std::vector<std::string> warnings;
};

template <>
inline constexpr auto kResult<PredictedTarget> = ResultType(
    "PredictedTarget", "A target predicted by a regression.", fields_of(&PredictedTarget::predicted),
    Field{"goes_on", may_lack(&PredictedTarget::goes_on),
          "by effects: from the end of training, or an earlier prediction"},
    Field{"holds_training", may_lack(&PredictedTarget::holds), "by effects: whether it begins with the training rows"},
    Field{"drivers", may_lack(&PredictedTarget::drivers), "by effects: the largest share first"},
    Field{"error", &PredictedTarget::error, "null: the target is not measured"},
    Field{"broken", may_lack(&PredictedTarget::broken), "by temperatures: sensors that look so"},
    Field{"warnings", &PredictedTarget::warnings});

// Of `train` on temperatures, and of batches weighted for a job.

inline constexpr FieldList kRegressionSettings{Field{"method", &RegressionSettings::method, "pcr, ridge"},
                                               Field{"components", &RegressionSettings::components},
                                               Field{"penalty_K2", &RegressionSettings::penalty_K2, "of ridge"}};

inline constexpr FieldList kContenderErrors{
    Field{"held_out_um", in(&Contender::held_out, &HeldOutErrors::rms_um), "RMSE of batches left out"},
    Field{"worst_um", in(&Contender::held_out, &HeldOutErrors::worst_um), "of the worst of them"},
    Field{"worst_batch", &Contender::worst}, Field{"rmse_um", &Contender::rmse_um, "of all batches, trained on"}};

template <>
inline constexpr auto kResult<Contender> = ResultType("TrainedMethod", "A method of regression.",
                                                      fields_of(&Contender::settings, kRegressionSettings),
                                                      kContenderErrors,
                                                      Field{"taken", &Contender::taken, "whether it is written"});

struct ComparedModel {
  Contender contender;
};

template <>
inline constexpr auto kResult<ComparedModel> =
    ResultType("ComparedModel", "A model of effects in the same contest.",
               fields_of(&ComparedModel::contender, Field{"model", &Contender::label, "file"}, kContenderErrors));

struct TrainedOnTemperatures {
  std::string target;
  std::size_t batches = 0;
  double held_out_um = 0.0, half_width_um = 0.0;
  std::vector<Contender> methods;
  std::optional<ComparedModel> effects;
  std::vector<std::string> remarks;
};

template <>
inline constexpr auto kResult<TrainedOnTemperatures> = ResultType(
    "Trained", "A regression on temperatures over batches.",
    Field{"target", &TrainedOnTemperatures::target, "column that is predicted"},
    Field{"batches", &TrainedOnTemperatures::batches, "how many"},
    Field{"held_out_um", &TrainedOnTemperatures::held_out_um, "RMSE on what was left out"},
    Field{"half_width_um", &TrainedOnTemperatures::half_width_um, "of the interval of 95 %"},
    Field{"methods", &TrainedOnTemperatures::methods, "that were compared"},
    Field{"effects", may_lack(&TrainedOnTemperatures::effects), "with --model: a model of effects in the same contest"},
    Field{"remarks", &TrainedOnTemperatures::remarks});

struct RankedBatch {
  std::string name;
  double distance = 0.0, weight = 0.0;
};

template <>
inline constexpr auto kResult<RankedBatch> = ResultType("RankedBatch", "A batch, and how like the job it is.",
                                                        Field{"batch", &RankedBatch::name},
                                                        Field{"distance", &RankedBatch::distance, "how unlike it is"},
                                                        Field{"weight", &RankedBatch::weight});

struct BatchChoice {
  std::string name;
  double batches = 0.0;
  RegressionSettings settings;
  std::optional<double> predicted_rmse_um;
};

template <>
inline constexpr auto kResult<BatchChoice> =
    ResultType("BatchChoice", "A way to choose batches.", Field{"choice", &BatchChoice::name, "weights, all"},
               Field{"batches", &BatchChoice::batches, "as many as these alike"},
               fields_of(&BatchChoice::settings, kRegressionSettings),
               Field{"predicted_rmse_um", &BatchChoice::predicted_rmse_um, "of the job; null: not measured"});

struct TrainedForJob {
  std::string target;
  double room_degC = 0.0;
  std::vector<RankedBatch> ranked;
  std::vector<BatchChoice> choices;  // by weights, and all
  std::vector<std::string> remarks;
};

template <>
inline constexpr auto kResult<TrainedForJob> = ResultType(
    "Selected", "Batches to train on for a job.", Field{"target", &TrainedForJob::target, "column that is predicted"},
    Field{"room_degC", &TrainedForJob::room_degC, "as the job begins"},
    Field{"ranked", &TrainedForJob::ranked, "batches, the most like the job first"},
    Field{"choices", &TrainedForJob::choices, "with what came of each"}, Field{"remarks", &TrainedForJob::remarks});

// Of `train` on effects.

inline constexpr FieldList kForecastTestErrors{
    Field{"count", &Forecasts::count, "of origins, or of runs left out"},
    Field{"error_um", &Forecasts::error_um, "mean of the absolute error"}, Field{"rmse_um", &Forecasts::rmse_um},
    Field{"held_um", &Forecasts::held_um, "RMSE where the last value, or the mean, is held; of runs 0 um"},
    Field{"within_share", &Forecasts::within_share, "within the interval of 95 %"}};

template <>
inline constexpr auto kResult<DriverStability> =
    ResultType("DriverStability", "A column that drives what is predicted.", fields_of(&DriverStability::share),
               Field{"low_um", &DriverStability::low_um, "least of refits without a part each"},
               Field{"high_um", &DriverStability::high_um, "largest of them"},
               Field{"stable", &DriverStability::stable}, Field{"flips", &DriverStability::flips, "its sign does"});

template <>
inline constexpr auto kResult<CancellingColumns> =
    ResultType("CancellingColumns", "Two columns that nearly cancel: neither is a cause by itself.",
               Field{"columns",
                     [](const CancellingColumns& of) {
                       return std::vector{of.first, of.second};
                     }},
               Field{"range_um",
                     [](const CancellingColumns& of) {
                       return std::vector{of.first_um, of.second_um};
                     },
                     "of each"},
               Field{"sum_um", &CancellingColumns::sum_um, "range of both together"});

// Of the runs that were left out one by one, the one that is predicted worst.
struct WorstRun {
  std::string run;
  double rmse_um = 0.0;
};

template <>
inline constexpr auto kResult<WorstRun> = ResultType("WorstRun",
                                                     "The run that is predicted worst where it is left out.",
                                                     Field{"run", &WorstRun::run, "its name"},
                                                     Field{"rmse_um", &WorstRun::rmse_um});

template <>
inline constexpr auto kResult<NamedEffect> =
    ResultType("NamedEffect", "An effect of a model in a regression, and what it makes of it.",
               Field{"label", &NamedEffect::label, "the effect with its columns"},
               Field{"share_um", &NamedEffect::share_um, "of the range that is predicted"},
               Field{"sigma_um", &NamedEffect::sigma_um, "of its gain alone"});

template <>
inline constexpr auto kResult<NamedEffects> =
    ResultType("NamedEffects", "The effects of a model among those of a regression.",
               Field{"effects", &NamedEffects::effects, "empty: no model, or left out"},
               Field{"rest_um", &NamedEffects::rest_um, "share of the range that has no named cause"},
               Field{"with_um", &NamedEffects::with_um, "RMSE of forecasts with them; null: no model, or no forecasts"},
               Field{"without_um", &NamedEffects::without_um, "and without; null: not tried"});

template <>
inline constexpr auto kResult<Start> =
    ResultType("Start", "A regression of other machines that this one started from.",
               Field{"used", &Start::used, "false: forecasts are better without it"},
               Field{"own_um", &Start::own_um, "share of the range that is this machine's own"},
               Field{"start_um", &Start::start_um, "and that is the other's"},
               Field{"borrowed", &Start::borrowed, "share of the variance that its rows do not settle, 0 to 1"},
               Field{"adapted_um", &Start::adapted_um, "RMSE of forecasts with it; null: no forecasts"},
               Field{"alone_um", &Start::alone_um, "and without it"});

template <>
inline constexpr auto kResult<SensorSet> =
    ResultType("SensorSet", "Temperature sensors of a number, and how well they predict.",
               Field{"sensors", &SensorSet::sensors, "chosen by all rows, the newest last"},
               fields_of(&SensorSet::forecasts, kForecastTestErrors),
               Field{"buys_um", &SensorSet::buys_um, "by how much error_um is below that of the set before"},
               Field{"sigma_buys_um", &SensorSet::sigma_buys_um, "its standard error; null: of one fold"});

template <>
inline constexpr auto kResult<ChosenSensor> =
    ResultType("ChosenSensor", "A sensor of the set that is written.", Field{"sensor", &ChosenSensor::sensor},
               Field{"folds", &ChosenSensor::folds, "forecasts, or runs left out, that choose it, too"},
               Field{"without_um", &ChosenSensor::without_um, "by how much error_um rises without it"},
               Field{"sigma_um", &ChosenSensor::sigma_um, "standard error of that"},
               Field{"needed", &ChosenSensor::needed, "false: without it the set is as good"},
               Field{"substitutes", &ChosenSensor::substitutes, "with one of these in its place the set is as good"});

template <>
inline constexpr auto kResult<SensorChoice> =
    ResultType("SensorChoice", "Which temperature sensors are worth having.",
               Field{"folds", &SensorChoice::folds, "forecasts, or runs left out, by which they are judged"},
               Field{"rated", &SensorChoice::rated, "sensors to choose from"},
               Field{"enough", &SensorChoice::enough, "the fewest that are as good as the best"},
               Field{"sets", &SensorChoice::sets, "of 0, 1, 2 ... sensors; the last one is written"},
               Field{"all", &SensorChoice::all, "of all sensors; the set before is the last of sets"},
               Field{"chosen", &SensorChoice::chosen, "of the last of sets"},
               Field{"kept", &SensorChoice::kept, "columns that are no temperatures"});

// A regression with the test by forecasts.
struct ForecastTest {
  Forecasts forecasts;
  bool predicted = false;
};
std::optional<ForecastTest> forecast_test(const EffectRegression& regression);

template <>
inline constexpr auto kResult<ForecastTest> = ResultType("Forecasts", "Rows that the training did not have, predicted.",
                                                         fields_of(&ForecastTest::forecasts, kForecastTestErrors),
                                                         Field{"predicted", &ForecastTest::predicted,
                                                               "whether that is better than chance"});

struct TrainedOnEffects {
  TrainedRegression trained;
  std::optional<WorstRun> worst;
  std::vector<Contender> methods;
  std::optional<SensorChoice> sensors;
  std::vector<ColumnFault> faults;
  std::vector<std::string> remarks;
  std::string sentence;
};

inline const std::string& first_target(const EffectRegression& of) { return of.model.targets.front(); }
constexpr auto of_regression(auto... get) {
  return in(&TrainedOnEffects::trained, &TrainedRegression::regression, get...);
}

template <>
inline constexpr auto kResult<TrainedOnEffects> = ResultType(
    "TrainedOnEffects", "A regression on the effects of the catalogue.",
    Field{"target", of_regression(&first_target), "column that is predicted"},
    Field{"target_unit", of_regression(&first_target, &unit_of),
          "for which um stands in the other keys; empty: the column states none"},
    Field{"rows", of_regression(&EffectRegression::rows), "trained on"},
    Field{"runs", of_regression(&EffectRegression::runs)},
    Field{"dictionary", of_regression(&EffectRegression::dictionary), "kinds of effects"},
    Field{"terms", count(of_regression(&EffectRegression::model, &Model::terms)), "how many"},
    Field{"prior_variance", of_regression(&EffectRegression::prior_variance), "of the gains"},
    Field{"length_s", of_regression(&EffectRegression::length_s), "memory of what no column drives; 0: none"},
    Field{"sigma_um", of_regression(&EffectRegression::sigma_um), "standard deviation of that"},
    Field{"interval_scale", of_regression(&EffectRegression::interval_scale), "by which the interval is widened"},
    Field{"rmse_um", of_regression(&EffectRegression::rmse_um), "on the rows that it was trained on"},
    Field{"forecasts", of_regression(&forecast_test), "null: too few rows"},
    Field{"worst", &TrainedOnEffects::worst, "null: fewer than five runs"},
    fields_of(in(&TrainedOnEffects::trained, &TrainedRegression::drivers),
              Field{"drivers", &DriverReport::drivers, "columns, and the um that each moves"},
              Field{"range_um", &DriverReport::range_um, "of what is predicted"},
              Field{"not_needed", &DriverReport::not_needed, "columns without which nothing changes"},
              Field{"interchangeable", &DriverReport::interchangeable, "sets of columns, of which any will do"},
              Field{"cancelling", &DriverReport::cancelling, "pairs of columns"}),
    fields_of(&TrainedOnEffects::trained, Field{"named", &TrainedRegression::named, "of --model"},
              Field{"start", &TrainedRegression::start, "of --start-from; null: none"}),
    Field{"methods", &TrainedOnEffects::methods, "of a list of runs: in the same contest"},
    Field{"sensors", may_lack(&TrainedOnEffects::sensors), "with --sensors: which are worth having"},
    Field{"faults", &TrainedOnEffects::faults, "of columns, that bear on what is said; readings far off are set aside"},
    Field{"remarks", &TrainedOnEffects::remarks},
    Field{"sentence", &TrainedOnEffects::sentence, "what it says in plain words"});

}  // namespace ballbar

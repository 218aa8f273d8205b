// What `train --json` and `predict --json` print.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/predict/batch_choice.hpp"
#include "ballbar/predict/effect_regression.hpp"
#include "ballbar/predict/prediction.hpp"
#include "ballbar/series/series.hpp"
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

struct ForecastTest {
  Forecasts forecasts;
  bool predicted = false;
};

template <>
struct ResultType<ForecastTest> {
  static constexpr std::string_view name = "Forecasts";
  static constexpr std::string_view meaning = "Rows that the training did not have, predicted.";
  static constexpr std::tuple errors{
      Field{"count", &Forecasts::count, "of origins, or of runs left out"},
      Field{"error_um", &Forecasts::error_um, "mean of the absolute error"}, Field{"rmse_um", &Forecasts::rmse_um, ""},
      Field{"held_um", &Forecasts::held_um, "RMSE where the last value, or the mean, is held; of runs 0 um"},
      Field{"within_share", &Forecasts::within_share, "within the interval of 95 %"}};
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&ForecastTest::forecasts, errors),
                     std::tuple{Field{"predicted", &ForecastTest::predicted, "whether that is better than chance"}});
};

template <>
struct ResultType<DriverShare> {
  static constexpr std::string_view name = "DriverShare";
  static constexpr std::string_view meaning = "How much of what is predicted goes with a column.";
  static constexpr std::tuple fields{Field{"column", &DriverShare::column, ""},
                                     Field{"role", &DriverShare::role, "as of a series"},
                                     Field{"share_um", &DriverShare::share_um, "of the range of what is predicted"}};
};

template <>
struct ResultType<DriverStability> {
  static constexpr std::string_view name = "DriverStability";
  static constexpr std::string_view meaning = "A column that drives what is predicted.";
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&DriverStability::share, ResultType<DriverShare>::fields),
                     std::tuple{Field{"low_um", &DriverStability::low_um, "least of refits without a part each"},
                                Field{"high_um", &DriverStability::high_um, "largest of them"},
                                Field{"stable", &DriverStability::stable, ""},
                                Field{"flips", &DriverStability::flips, "its sign does"}});
};

template <>
struct ResultType<CancellingColumns> {
  using Of = const CancellingColumns&;
  static constexpr std::string_view name = "CancellingColumns";
  static constexpr std::string_view meaning = "Two columns that nearly cancel: neither is a cause by itself.";
  static constexpr std::tuple fields{Field{"columns",
                                           [](Of of) {
                                             return std::vector{of.first, of.second};
                                           },
                                           ""},
                                     Field{"range_um",
                                           [](Of of) {
                                             return std::vector{of.first_um, of.second_um};
                                           },
                                           "of each"},
                                     Field{"sum_um", &CancellingColumns::sum_um, "range of both together"}};
};

// Of the runs that were left out one by one, the one that is predicted worst.
struct WorstRun {
  std::string run;
  double rmse_um = 0.0;
};

template <>
struct ResultType<WorstRun> {
  static constexpr std::string_view name = "WorstRun";
  static constexpr std::string_view meaning = "The run that is predicted worst where it is left out.";
  static constexpr std::tuple fields{Field{"run", &WorstRun::run, "its name"},
                                     Field{"rmse_um", &WorstRun::rmse_um, ""}};
};

template <>
struct ResultType<NamedEffect> {
  static constexpr std::string_view name = "NamedEffect";
  static constexpr std::string_view meaning = "An effect of a model in a regression, and what it makes of it.";
  static constexpr std::tuple fields{Field{"label", &NamedEffect::label, "the effect with its columns"},
                                     Field{"share_um", &NamedEffect::share_um, "of the range that is predicted"},
                                     Field{"sigma_um", &NamedEffect::sigma_um, "of its gain alone"}};
};

template <>
struct ResultType<NamedEffects> {
  static constexpr std::string_view name = "NamedEffects";
  static constexpr std::string_view meaning = "The effects of a model among those of a regression.";
  static constexpr std::tuple fields{
      Field{"effects", &NamedEffects::effects, "empty: no model, or left out"},
      Field{"rest_um", &NamedEffects::rest_um, "share of the range that has no named cause"},
      Field{"with_um", &NamedEffects::with_um, "RMSE of forecasts with them; null: no model, or no forecasts"},
      Field{"without_um", &NamedEffects::without_um, "and without; null: not tried"}};
};

template <>
struct ResultType<Start> {
  static constexpr std::string_view name = "Start";
  static constexpr std::string_view meaning = "A regression of other machines that this one started from.";
  static constexpr std::tuple fields{
      Field{"used", &Start::used, "false: forecasts are better without it"},
      Field{"own_um", &Start::own_um, "share of the range that is this machine's own"},
      Field{"start_um", &Start::start_um, "and that is the other's"},
      Field{"borrowed", &Start::borrowed, "share of the variance that its rows do not settle, 0 to 1"},
      Field{"adapted_um", &Start::adapted_um, "RMSE of forecasts with it; null: no forecasts"},
      Field{"alone_um", &Start::alone_um, "and without it"}};
};

template <>
struct ResultType<SensorSet> {
  using Of = const SensorSet&;
  static constexpr std::string_view name = "SensorSet";
  static constexpr std::string_view meaning = "Temperature sensors of a number, and how well they predict.";
  static constexpr std::tuple fields = std::tuple_cat(
      std::tuple{Field{"sensors", &SensorSet::sensors, "chosen by all rows, the newest last"}},
      fields_through(&SensorSet::forecasts, ResultType<ForecastTest>::errors),
      std::tuple{Field{"buys_um", &SensorSet::buys_um, "by how much error_um is below that of the set before"},
                 Field{"sigma_buys_um", &SensorSet::sigma_buys_um, "its standard error; null: of one fold"}});
};

template <>
struct ResultType<ChosenSensor> {
  static constexpr std::string_view name = "ChosenSensor";
  static constexpr std::string_view meaning = "A sensor of the set that is written.";
  static constexpr std::tuple fields{
      Field{"sensor", &ChosenSensor::sensor, ""},
      Field{"folds", &ChosenSensor::folds, "forecasts, or runs left out, that choose it, too"},
      Field{"without_um", &ChosenSensor::without_um, "by how much error_um rises without it"},
      Field{"sigma_um", &ChosenSensor::sigma_um, "standard error of that"},
      Field{"needed", &ChosenSensor::needed, "false: without it the set is as good"},
      Field{"substitutes", &ChosenSensor::substitutes, "with one of these in its place the set is as good"}};
};

template <>
struct ResultType<SensorChoice> {
  static constexpr std::string_view name = "SensorChoice";
  static constexpr std::string_view meaning = "Which temperature sensors are worth having.";
  static constexpr std::tuple fields{
      Field{"folds", &SensorChoice::folds, "forecasts, or runs left out, by which they are judged"},
      Field{"rated", &SensorChoice::rated, "sensors to choose from"},
      Field{"enough", &SensorChoice::enough, "the fewest that are as good as the best"},
      Field{"sets", &SensorChoice::sets, "of 0, 1, 2 ... sensors; the last one is written"},
      Field{"all", &SensorChoice::all, "of all sensors; the set before is the last of sets"},
      Field{"chosen", &SensorChoice::chosen, "of the last of sets"},
      Field{"kept", &SensorChoice::kept, "columns that are no temperatures"}};
};

struct TrainedOnEffects {
  EffectRegression regression;
  std::optional<ForecastTest> forecasts;
  std::optional<WorstRun> worst;
  DriverReport drivers;
  NamedEffects named;
  std::optional<Start> start;
  std::vector<Contender> methods;
  MayLack<SensorChoice> sensors;
  std::vector<std::string> remarks;
  std::string sentence;
};

template <>
struct ResultType<TrainedOnEffects> {
  static constexpr std::string_view name = "TrainedOnEffects";
  static constexpr std::string_view meaning = "A regression on the effects of the catalogue.";
  static constexpr std::tuple of_regression{
      Field{"target", [](const EffectRegression& of) { return of.model.targets.front(); }, "column that is predicted"},
      Field{"target_unit", [](const EffectRegression& of) { return std::string(unit_of(of.model.targets.front())); },
            "for which um stands in the other keys; empty: the column states none"},
      Field{"rows", &EffectRegression::rows, "trained on"},
      Field{"runs", &EffectRegression::runs, ""},
      Field{"dictionary", &EffectRegression::dictionary, "kinds of effects"},
      Field{"terms", [](const EffectRegression& of) { return of.model.terms.size(); }, "how many"},
      Field{"prior_variance", &EffectRegression::prior_variance, "of the gains"},
      Field{"length_s", &EffectRegression::length_s, "memory of what no column drives; 0: none"},
      Field{"sigma_um", &EffectRegression::sigma_um, "standard deviation of that"},
      Field{"interval_scale", &EffectRegression::interval_scale, "by which the interval is widened"},
      Field{"rmse_um", &EffectRegression::rmse_um, "on the rows that it was trained on"}};
  static constexpr std::tuple of_drivers{
      Field{"drivers", &DriverReport::drivers, "columns, and the um that each moves"},
      Field{"range_um", &DriverReport::range_um, "of what is predicted"},
      Field{"not_needed", &DriverReport::not_needed, "columns without which nothing changes"},
      Field{"interchangeable", &DriverReport::interchangeable, "sets of columns, of which any will do"},
      Field{"cancelling", &DriverReport::cancelling, "pairs of columns"}};
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&TrainedOnEffects::regression, of_regression),
                     std::tuple{Field{"forecasts", &TrainedOnEffects::forecasts, "null: too few rows"},
                                Field{"worst", &TrainedOnEffects::worst, "null: fewer than five runs"}},
                     fields_through(&TrainedOnEffects::drivers, of_drivers),
                     std::tuple{Field{"named", &TrainedOnEffects::named, "of --model"},
                                Field{"start", &TrainedOnEffects::start, "of --start-from; null: none"},
                                Field{"methods", &TrainedOnEffects::methods, "of a list of runs: in the same contest"},
                                Field{"sensors", &TrainedOnEffects::sensors, "with --sensors: which are worth having"},
                                Field{"remarks", &TrainedOnEffects::remarks, ""},
                                Field{"sentence", &TrainedOnEffects::sentence, "what it says in plain words"}});
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

struct PredictedSeries {
  Series series;
};

template <>
struct ResultType<PredictedSeries> {
  static constexpr std::string_view name = "Predicted";
  static constexpr std::string_view meaning = "A model's series.";
  static constexpr std::tuple fields{
      Field{"time_s", [](const PredictedSeries& of) { return of.series.time_s; }, "of each row"},
      Field{"COLUMN",
            [](const PredictedSeries& of) {
              KeysOf<std::vector<double>> columns;
              for (const Column& column : of.series.columns) columns.values.emplace_back(column.name, column.values);
              return columns;
            },
            "TARGET_model_um, the target, TARGET_residual_um, and what each effect adds"}};
};

template <>
struct ResultType<PredictionError> {
  static constexpr std::string_view name = "PredictionError";
  static constexpr std::string_view meaning = "Measured less predicted, of rows that are new.";
  static constexpr std::tuple fields{
      Field{"rows", &PredictionError::rows, "how many"},
      Field{"mean_um", &PredictionError::mean_um, "mean of the absolute error"},
      Field{"rmse_um", &PredictionError::rmse_um, ""},
      Field{"within_share", &PredictionError::within_share, "within the interval of 95 %"}};
};

struct PredictedTarget {
  PredictedSeries predicted;
  MayLack<bool> goes_on, holds;
  MayLack<std::vector<DriverShare>> drivers;
  std::optional<PredictionError> error;
  MayLack<std::vector<std::string>> broken;
  std::vector<std::string> warnings;
};

template <>
struct ResultType<PredictedTarget> {
  static constexpr std::string_view name = "PredictedTarget";
  static constexpr std::string_view meaning = "A target predicted by a regression.";
  static constexpr std::tuple fields = std::tuple_cat(
      fields_through(&PredictedTarget::predicted, ResultType<PredictedSeries>::fields),
      std::tuple{
          Field{"goes_on", &PredictedTarget::goes_on, "by effects: from the end of training, or an earlier prediction"},
          Field{"holds_training", &PredictedTarget::holds, "by effects: whether it begins with the training rows"},
          Field{"drivers", &PredictedTarget::drivers, "by effects: the largest share first"},
          Field{"error", &PredictedTarget::error, "null: the target is not measured"},
          Field{"broken", &PredictedTarget::broken, "by temperatures: sensors that look so"},
          Field{"warnings", &PredictedTarget::warnings, ""}});
};

}  // namespace ballbar

// What `train --json` prints of a regression on effects.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/predict/effect_regression.hpp"
#include "ballbar/predict/sensor_choice.hpp"
#include "ballbar/series/series.hpp"
#include "predict/predict_result.hpp"
#include "predict/training_result.hpp"

namespace ballbar {

struct ForecastTest {
  Forecasts forecasts;
  bool predicted = false;
};

inline constexpr auto kForecastTestErrors = std::tuple{
    Field{"count", &Forecasts::count, "of origins, or of runs left out"},
    Field{"error_um", &Forecasts::error_um, "mean of the absolute error"}, Field{"rmse_um", &Forecasts::rmse_um, ""},
    Field{"held_um", &Forecasts::held_um, "RMSE where the last value, or the mean, is held; of runs 0 um"},
    Field{"within_share", &Forecasts::within_share, "within the interval of 95 %"}};

template <>
inline constexpr auto kResult<ForecastTest> = ResultType{
    "Forecasts", "Rows that the training did not have, predicted.",
    std::tuple_cat(fields_through(&ForecastTest::forecasts, kForecastTestErrors),
                   std::tuple{Field{"predicted", &ForecastTest::predicted, "whether that is better than chance"}})};

template <>
inline constexpr auto kResult<DriverStability> = ResultType{
    "DriverStability", "A column that drives what is predicted.",
    std::tuple_cat(fields_through(&DriverStability::share, kResult<DriverShare>.fields),
                   std::tuple{Field{"low_um", &DriverStability::low_um, "least of refits without a part each"},
                              Field{"high_um", &DriverStability::high_um, "largest of them"},
                              Field{"stable", &DriverStability::stable, ""},
                              Field{"flips", &DriverStability::flips, "its sign does"}})};

template <>
inline constexpr auto kResult<CancellingColumns> =
    ResultType{"CancellingColumns", "Two columns that nearly cancel: neither is a cause by itself.",
               std::tuple{Field{"columns",
                                [](const CancellingColumns& of) {
                                  return std::vector{of.first, of.second};
                                },
                                ""},
                          Field{"range_um",
                                [](const CancellingColumns& of) {
                                  return std::vector{of.first_um, of.second_um};
                                },
                                "of each"},
                          Field{"sum_um", &CancellingColumns::sum_um, "range of both together"}}};

// Of the runs that were left out one by one, the one that is predicted worst.
struct WorstRun {
  std::string run;
  double rmse_um = 0.0;
};

template <>
inline constexpr auto kResult<WorstRun> =
    ResultType{"WorstRun", "The run that is predicted worst where it is left out.",
               std::tuple{Field{"run", &WorstRun::run, "its name"}, Field{"rmse_um", &WorstRun::rmse_um, ""}}};

template <>
inline constexpr auto kResult<NamedEffect> =
    ResultType{"NamedEffect", "An effect of a model in a regression, and what it makes of it.",
               std::tuple{Field{"label", &NamedEffect::label, "the effect with its columns"},
                          Field{"share_um", &NamedEffect::share_um, "of the range that is predicted"},
                          Field{"sigma_um", &NamedEffect::sigma_um, "of its gain alone"}}};

template <>
inline constexpr auto kResult<NamedEffects> = ResultType{
    "NamedEffects", "The effects of a model among those of a regression.",
    std::tuple{Field{"effects", &NamedEffects::effects, "empty: no model, or left out"},
               Field{"rest_um", &NamedEffects::rest_um, "share of the range that has no named cause"},
               Field{"with_um", &NamedEffects::with_um, "RMSE of forecasts with them; null: no model, or no forecasts"},
               Field{"without_um", &NamedEffects::without_um, "and without; null: not tried"}}};

template <>
inline constexpr auto kResult<Start> = ResultType{
    "Start", "A regression of other machines that this one started from.",
    std::tuple{Field{"used", &Start::used, "false: forecasts are better without it"},
               Field{"own_um", &Start::own_um, "share of the range that is this machine's own"},
               Field{"start_um", &Start::start_um, "and that is the other's"},
               Field{"borrowed", &Start::borrowed, "share of the variance that its rows do not settle, 0 to 1"},
               Field{"adapted_um", &Start::adapted_um, "RMSE of forecasts with it; null: no forecasts"},
               Field{"alone_um", &Start::alone_um, "and without it"}}};

template <>
inline constexpr auto kResult<SensorSet> = ResultType{
    "SensorSet", "Temperature sensors of a number, and how well they predict.",
    std::tuple_cat(
        std::tuple{Field{"sensors", &SensorSet::sensors, "chosen by all rows, the newest last"}},
        fields_through(&SensorSet::forecasts, kForecastTestErrors),
        std::tuple{Field{"buys_um", &SensorSet::buys_um, "by how much error_um is below that of the set before"},
                   Field{"sigma_buys_um", &SensorSet::sigma_buys_um, "its standard error; null: of one fold"}})};

template <>
inline constexpr auto kResult<ChosenSensor> = ResultType{
    "ChosenSensor", "A sensor of the set that is written.",
    std::tuple{Field{"sensor", &ChosenSensor::sensor, ""},
               Field{"folds", &ChosenSensor::folds, "forecasts, or runs left out, that choose it, too"},
               Field{"without_um", &ChosenSensor::without_um, "by how much error_um rises without it"},
               Field{"sigma_um", &ChosenSensor::sigma_um, "standard error of that"},
               Field{"needed", &ChosenSensor::needed, "false: without it the set is as good"},
               Field{"substitutes", &ChosenSensor::substitutes, "with one of these in its place the set is as good"}}};

template <>
inline constexpr auto kResult<SensorChoice> =
    ResultType{"SensorChoice", "Which temperature sensors are worth having.",
               std::tuple{Field{"folds", &SensorChoice::folds, "forecasts, or runs left out, by which they are judged"},
                          Field{"rated", &SensorChoice::rated, "sensors to choose from"},
                          Field{"enough", &SensorChoice::enough, "the fewest that are as good as the best"},
                          Field{"sets", &SensorChoice::sets, "of 0, 1, 2 ... sensors; the last one is written"},
                          Field{"all", &SensorChoice::all, "of all sensors; the set before is the last of sets"},
                          Field{"chosen", &SensorChoice::chosen, "of the last of sets"},
                          Field{"kept", &SensorChoice::kept, "columns that are no temperatures"}}};

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

inline constexpr auto kTrainedOnEffectsOfRegression = std::tuple{
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
inline constexpr auto kTrainedOnEffectsOfDrivers =
    std::tuple{Field{"drivers", &DriverReport::drivers, "columns, and the um that each moves"},
               Field{"range_um", &DriverReport::range_um, "of what is predicted"},
               Field{"not_needed", &DriverReport::not_needed, "columns without which nothing changes"},
               Field{"interchangeable", &DriverReport::interchangeable, "sets of columns, of which any will do"},
               Field{"cancelling", &DriverReport::cancelling, "pairs of columns"}};

template <>
inline constexpr auto kResult<TrainedOnEffects> = ResultType{
    "TrainedOnEffects", "A regression on the effects of the catalogue.",
    std::tuple_cat(fields_through(&TrainedOnEffects::regression, kTrainedOnEffectsOfRegression),
                   std::tuple{Field{"forecasts", &TrainedOnEffects::forecasts, "null: too few rows"},
                              Field{"worst", &TrainedOnEffects::worst, "null: fewer than five runs"}},
                   fields_through(&TrainedOnEffects::drivers, kTrainedOnEffectsOfDrivers),
                   std::tuple{Field{"named", &TrainedOnEffects::named, "of --model"},
                              Field{"start", &TrainedOnEffects::start, "of --start-from; null: none"},
                              Field{"methods", &TrainedOnEffects::methods, "of a list of runs: in the same contest"},
                              Field{"sensors", &TrainedOnEffects::sensors, "with --sensors: which are worth having"},
                              Field{"remarks", &TrainedOnEffects::remarks, ""},
                              Field{"sentence", &TrainedOnEffects::sentence, "what it says in plain words"}})};

}  // namespace ballbar

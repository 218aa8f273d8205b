// What `train --json` prints.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/batches/batch_regression.hpp"
#include "ballbar/effect_regression/effect_regression.hpp"
#include "ballbar/formats/results/result_type.hpp"
#include "batches/train_effects.hpp"

namespace ballbar {

// One method with the settings it is trained with.
struct Contender {
  RegressionSettings settings;
  double held_out_um = 0.0;
  double worst_um = 0.0;
  std::string worst;
  double rmse_um = 0.0;
};

inline constexpr std::tuple kContenderErrors{Field{"held_out_um", &Contender::held_out_um, "RMSE of batches left out"},
                                             Field{"worst_um", &Contender::worst_um, "of the worst of them"},
                                             Field{"worst_batch", &Contender::worst, ""},
                                             Field{"rmse_um", &Contender::rmse_um, "of all batches, trained on"}};

struct TrainedMethod {
  Contender contender;
  bool taken = false;
};

template <>
struct ResultType<TrainedMethod> {
  using Of = const TrainedMethod&;
  static constexpr std::string_view name = "TrainedMethod";
  static constexpr std::string_view meaning = "A method of regression.";
  static constexpr std::tuple fields = std::tuple_cat(
      std::tuple{Field{"method", [](Of of) { return of.contender.settings.method; }, "pcr, ridge, ..."},
                 Field{"components", [](Of of) { return of.contender.settings.components; }, ""},
                 Field{"penalty_K2", [](Of of) { return of.contender.settings.penalty_K2; }, "of ridge"}},
      fields_through(&TrainedMethod::contender, kContenderErrors),
      std::tuple{Field{"taken", &TrainedMethod::taken, "whether it is written"}});
};

struct ComparedModel {
  std::string model;
  Contender contender;
};

template <>
struct ResultType<ComparedModel> {
  static constexpr std::string_view name = "ComparedModel";
  static constexpr std::string_view meaning = "A model of effects in the same contest.";
  static constexpr std::tuple fields = std::tuple_cat(std::tuple{Field{"model", &ComparedModel::model, "file"}},
                                                      fields_through(&ComparedModel::contender, kContenderErrors));
};

struct TrainedOnBatches {
  std::string target;
  std::size_t batches = 0;
  double held_out_um = 0.0, half_width_um = 0.0;
  std::vector<TrainedMethod> methods;
  MayLack<ComparedModel> effects;
  std::vector<std::string> remarks;
};

template <>
struct ResultType<TrainedOnBatches> {
  static constexpr std::string_view name = "Trained";
  static constexpr std::string_view meaning = "A regression on temperatures over batches.";
  static constexpr std::tuple fields{
      Field{"target", &TrainedOnBatches::target, "column that is predicted"},
      Field{"batches", &TrainedOnBatches::batches, "how many"},
      Field{"held_out_um", &TrainedOnBatches::held_out_um, "RMSE on what was left out"},
      Field{"half_width_um", &TrainedOnBatches::half_width_um, "of the interval of 95 %"},
      Field{"methods", &TrainedOnBatches::methods, "that were compared"},
      Field{"effects", &TrainedOnBatches::effects, "with --model: a model of effects in the same contest"},
      Field{"remarks", &TrainedOnBatches::remarks, ""}};
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

template <>
struct ResultType<OtherMethod> {
  static constexpr std::string_view name = "OtherMethod";
  static constexpr std::string_view meaning = "A regression over batches in the same contest.";
  static constexpr std::tuple fields{Field{"label", &OtherMethod::label, ""},
                                     Field{"held_out_um", &OtherMethod::left_out_um, "RMSE of batches left out"}};
};

struct TrainedOnEffects {
  EffectRegression regression;
  std::optional<ForecastTest> forecasts;
  DriverReport drivers;
  std::vector<OtherMethod> methods;
  std::vector<std::string> remarks;
  std::string sentence;
};

template <>
struct ResultType<TrainedOnEffects> {
  static constexpr std::string_view name = "TrainedOnEffects";
  static constexpr std::string_view meaning = "A regression on the effects of the catalogue.";
  static constexpr std::tuple of_regression{
      Field{"target", [](const EffectRegression& of) { return of.model.targets.front(); }, "column that is predicted"},
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
                     std::tuple{Field{"forecasts", &TrainedOnEffects::forecasts, "null: too few rows"}},
                     fields_through(&TrainedOnEffects::drivers, of_drivers),
                     std::tuple{Field{"methods", &TrainedOnEffects::methods, "of a list of runs: in the same contest"},
                                Field{"remarks", &TrainedOnEffects::remarks, ""},
                                Field{"sentence", &TrainedOnEffects::sentence, "what it says in plain words"}});
};

}  // namespace ballbar

// What `predict --json` prints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/series/series.hpp"
#include "batches/train_result.hpp"

namespace ballbar {

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

struct PredictedJob {
  PredictedSeries predicted;
  std::vector<std::string> broken, warnings;
};

template <>
struct ResultType<PredictedJob> {
  static constexpr std::string_view name = "PredictedJob";
  static constexpr std::string_view meaning = "A job predicted by a regression over batches.";
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&PredictedJob::predicted, ResultType<PredictedSeries>::fields),
                     std::tuple{Field{"broken", &PredictedJob::broken, "sensors that look so"},
                                Field{"warnings", &PredictedJob::warnings, ""}});
};

// Measured less predicted.
struct NewRowsError {
  double mean_um = 0.0, rmse_um = 0.0, within = 0.0;
  std::size_t rows = 0;
};

template <>
struct ResultType<NewRowsError> {
  static constexpr std::string_view name = "PredictionError";
  static constexpr std::string_view meaning = "Measured less predicted, of rows that are new.";
  static constexpr std::tuple fields{Field{"rows", &NewRowsError::rows, "how many"},
                                     Field{"mean_um", &NewRowsError::mean_um, "mean of the absolute error"},
                                     Field{"rmse_um", &NewRowsError::rmse_um, ""},
                                     Field{"within_share", &NewRowsError::within, "within the interval of 95 %"}};
};

struct PredictedByEffects {
  PredictedSeries predicted;
  bool goes_on = false, holds = false;
  std::vector<DriverShare> drivers;
  std::optional<NewRowsError> error;
  std::vector<std::string> warnings;
};

template <>
struct ResultType<PredictedByEffects> {
  static constexpr std::string_view name = "PredictedByEffects";
  static constexpr std::string_view meaning = "A series predicted by a regression on effects.";
  static constexpr std::tuple fields = std::tuple_cat(
      fields_through(&PredictedByEffects::predicted, ResultType<PredictedSeries>::fields),
      std::tuple{Field{"goes_on", &PredictedByEffects::goes_on, "from the end of training, or an earlier prediction"},
                 Field{"holds_training", &PredictedByEffects::holds, "whether it begins with the training rows"},
                 Field{"drivers", &PredictedByEffects::drivers, "the largest share first"},
                 Field{"error", &PredictedByEffects::error, "null: the target is not measured"},
                 Field{"warnings", &PredictedByEffects::warnings, ""}});
};

}  // namespace ballbar

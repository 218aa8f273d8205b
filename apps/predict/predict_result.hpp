// What `predict --json` prints.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/predict/prediction.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<DriverShare> = ResultType{
    "DriverShare", "How much of what is predicted goes with a column.",
    std::tuple{Field{"column", &DriverShare::column, ""}, Field{"role", &DriverShare::role, "as of a series"},
               Field{"share_um", &DriverShare::share_um, "of the range of what is predicted"}}};

template <>
inline constexpr auto kResult<Series> =
    ResultType{"Predicted", "A model's series.",
               std::tuple{Field{"time_s", &Series::time_s, "of each row"},
                          Field{"COLUMN",
                                [](const Series& of) {
                                  KeysOf<std::vector<double>> columns;
                                  for (const Column& column : of.columns)
                                    columns.values.emplace_back(column.name, column.values);
                                  return columns;
                                },
                                "TARGET_model_um, the target, TARGET_residual_um, and what each effect adds"}}};

template <>
inline constexpr auto kResult<PredictionError> =
    ResultType{"PredictionError", "Measured less predicted, of rows that are new.",
               std::tuple{Field{"rows", &PredictionError::rows, "how many"},
                          Field{"mean_um", &PredictionError::mean_um, "mean of the absolute error"},
                          Field{"rmse_um", &PredictionError::rmse_um, ""},
                          Field{"within_share", &PredictionError::within_share, "within the interval of 95 %"}}};

struct PredictedTarget {
  Series predicted;
  MayLack<bool> goes_on, holds;
  MayLack<std::vector<DriverShare>> drivers;
  std::optional<PredictionError> error;
  MayLack<std::vector<std::string>> broken;
  std::vector<std::string> warnings;
};

template <>
inline constexpr auto kResult<PredictedTarget> = ResultType{
    "PredictedTarget", "A target predicted by a regression.",
    std::tuple_cat(fields_through(&PredictedTarget::predicted, kResult<Series>.fields),
                   std::tuple{Field{"goes_on", &PredictedTarget::goes_on,
                                    "by effects: from the end of training, or an earlier prediction"},
                              Field{"holds_training", &PredictedTarget::holds,
                                    "by effects: whether it begins with the training rows"},
                              Field{"drivers", &PredictedTarget::drivers, "by effects: the largest share first"},
                              Field{"error", &PredictedTarget::error, "null: the target is not measured"},
                              Field{"broken", &PredictedTarget::broken, "by temperatures: sensors that look so"},
                              Field{"warnings", &PredictedTarget::warnings, ""}})};

}  // namespace ballbar

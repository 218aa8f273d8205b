// What `compensate --on --json` and `compensate --write --json` print.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

inline double largest_of(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

template <>
inline constexpr auto kResult<ReplayedAxis> = ResultType{
    "ReplayedAxis", "An axis before and after it is compensated.", std::tuple{
      Field{"target", &ReplayedAxis::target, "column that is compensated"},
      Field{"values", [](const ReplayedAxis& of) { return of.time_s.size() - 1; },
            "since the first, which is left out"},
      Field{"rms_before_um", [](const ReplayedAxis& of) { return of.reduction.before_um; }, ""},
      Field{"rms_after_um", [](const ReplayedAxis& of) { return of.reduction.after_um; }, ""},
      Field{"reduction_percent", [](const ReplayedAxis& of) { return 100.0 * of.reduction.share; }, ""},
      Field{"reduction_sigma_percent", [](const ReplayedAxis& of) { return 100.0 * of.reduction.sigma; }, ""},
      Field{"stretch", [](const ReplayedAxis& of) { return of.reduction.stretch; },
            "values over which the residual is correlated"},
      Field{"largest_before_um", [](const ReplayedAxis& of) { return largest_of(of.before_um); }, ""},
      Field{"largest_after_um", [](const ReplayedAxis& of) { return largest_of(of.after_um); }, ""},
      Field{"rows_held",
            [](const ReplayedAxis& of) {
              TableOf<std::size_t> rows;
              for (std::size_t kind = 1; kind < kHoldKinds; ++kind) {
                if (of.rows_held[kind] > 0) rows.emplace_back(name_of(Hold(kind)), of.rows_held[kind]);
              }
              return rows;
            },
            "by why"},
      Field{"most_held_by",
            [](const ReplayedAxis& of) {
              return MayLack<std::string>{of.most_held_by.empty() ? std::nullopt : std::optional(of.most_held_by)};
            },
            "column"},
      Field{"rows_limited", &ReplayedAxis::rows_limited, "by the limits"}}};

struct ReplayResult {
  std::size_t rows = 0;
  std::optional<bool> in_sample;
  TableOf<ReplayedAxis> axes;
};

template <>
inline constexpr auto kResult<ReplayResult> =
    ResultType{"Replayed", "A compensation replayed over what was recorded.",
               std::tuple{Field{"rows", &ReplayResult::rows, "of signals"},
                          Field{"in_sample", &ReplayResult::in_sample,
                                "whether it was fitted to these data; null: not known here"},
                          Field{"axes", &ReplayResult::axes, "by letter"}}};

template <>
inline constexpr auto kResult<SensorSlope> = ResultType{
    "SensorSlope", "A sensor's part of the line; temperatures in the unit of its column.",
    std::tuple{Field{"column", &SensorSlope::column, ""},
               Field{"slope_um_per_K", &SensorSlope::slope_um_per_K, "of the error, as written but for the sign"},
               Field{"sigma_um_per_K", &SensorSlope::sigma_um_per_K, "by leaving out runs, or fifths of one, in turn"},
               Field{"zero", &SensorSlope::zero, "where it adds nothing"},
               Field{"low", &SensorSlope::low, "end of what is believed"},
               Field{"high", &SensorSlope::high, "the other one"}}};

template <>
inline constexpr auto kResult<LineErrors> = ResultType{
    "LineErrors", "Errors since the zeros, with what is written.",
    std::tuple{Field{"values", &LineErrors::values, "without those at the zeros"},
               Field{"beyond", &LineErrors::beyond, "of these, with a reading beyond an end of the line"},
               Field{"rms_before_um", [](const LineErrors& of) { return of.line.before_um; }, ""},
               Field{"rms_model_um", [](const LineErrors& of) { return of.model.after_um; }, "with all of the model"},
               Field{"rms_line_um", [](const LineErrors& of) { return of.line.after_um; }, ""},
               Field{"reduction_model_percent", [](const LineErrors& of) { return 100.0 * of.model.share; }, ""},
               Field{"reduction_model_sigma_percent", [](const LineErrors& of) { return 100.0 * of.model.sigma; }, ""},
               Field{"reduction_line_percent", [](const LineErrors& of) { return 100.0 * of.line.share; }, ""},
               Field{"reduction_line_sigma_percent", [](const LineErrors& of) { return 100.0 * of.line.sigma; }, ""},
               Field{"largest_before_um", &LineErrors::largest_um, ""},
               Field{"largest_model_um", &LineErrors::largest_model_um, ""},
               Field{"largest_line_um", &LineErrors::largest_line_um, ""}}};

struct WrittenResult {
  std::string control, file, axis, target;
  std::optional<bool> in_sample;
  std::vector<SensorSlope> sensors;
  double increment_um = 0.0;
  std::size_t rows = 0, runs = 0;
  double rms_from_model_um = 0.0;
  LineErrors fitted;
  std::optional<LineErrors> left_out;
};

template <>
inline constexpr auto kResult<WrittenResult> = ResultType{
    "Written", "A model as a line for a control's own temperature compensation.",
    std::tuple{
        Field{"control", &WrittenResult::control, ""}, Field{"file", &WrittenResult::file, ""},
        Field{"axis", &WrittenResult::axis, ""}, Field{"target", &WrittenResult::target, "column that is compensated"},
        Field{"in_sample", &WrittenResult::in_sample,
              "whether the model was fitted to these data; null: not known here"},
        Field{"sensors", &WrittenResult::sensors, ""},
        Field{"increment_um", &WrittenResult::increment_um, "of the result"},
        Field{"rows", &WrittenResult::rows, "that the line is fitted to"}, Field{"runs", &WrittenResult::runs, ""},
        Field{"rms_from_model_um", &WrittenResult::rms_from_model_um, "of the model's prediction less the line"},
        Field{"fitted", &WrittenResult::fitted, "all values, which the line is fitted to"},
        Field{"left_out", &WrittenResult::left_out,
              "values that choice and slopes did not have: each run, or the last two fifths of one; null: too few"}}};

}  // namespace ballbar

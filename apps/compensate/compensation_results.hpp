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
constexpr double percent(double share) { return 100.0 * share; }
TableOf<std::size_t> rows_by_hold(const ReplayedAxis& axis);

template <>
inline constexpr auto kResult<ReplayedAxis> = ResultType(
    "ReplayedAxis", "An axis before and after it is compensated.",
    Field{"target", &ReplayedAxis::target, "column that is compensated"},
    Field{"values", [](const ReplayedAxis& of) { return of.time_s.size() - 1; }, "since the first, which is left out"},
    Field{"rms_before_um", in(&ReplayedAxis::reduction, &Reduction::before_um)},
    Field{"rms_after_um", in(&ReplayedAxis::reduction, &Reduction::after_um)},
    Field{"reduction_percent", in(&ReplayedAxis::reduction, &Reduction::share, &percent)},
    Field{"reduction_sigma_percent", in(&ReplayedAxis::reduction, &Reduction::sigma, &percent)},
    Field{"stretch", in(&ReplayedAxis::reduction, &Reduction::stretch), "values over which the residual is correlated"},
    Field{"largest_before_um", in(&ReplayedAxis::before_um, &largest_of)},
    Field{"largest_after_um", in(&ReplayedAxis::after_um, &largest_of)}, Field{"rows_held", &rows_by_hold, "by why"},
    Field{"most_held_by", may_lack(&ReplayedAxis::most_held_by), "column"},
    Field{"rows_limited", &ReplayedAxis::rows_limited, "by the limits"});

struct ReplayResult {
  Replay replay;
  std::optional<bool> in_sample;
};
TableOf<ReplayedAxis> replayed_axes(const Replay& replay);

template <>
inline constexpr auto kResult<ReplayResult> = ResultType(
    "Replayed", "A compensation replayed over what was recorded.",
    Field{"rows", in(&ReplayResult::replay, &Replay::rows), "of signals"},
    Field{"in_sample", &ReplayResult::in_sample, "whether it was fitted to these data; null: not known here"},
    Field{"axes", in(&ReplayResult::replay, &replayed_axes), "by letter"});

template <>
inline constexpr auto kResult<SensorSlope> = ResultType(
    "SensorSlope", "A sensor's part of the line; temperatures in the unit of its column.",
    Field{"column", &SensorSlope::column},
    Field{"slope_um_per_K", &SensorSlope::slope_um_per_K, "of the error, as written but for the sign"},
    Field{"sigma_um_per_K", &SensorSlope::sigma_um_per_K, "by leaving out runs, or fifths of one, in turn"},
    Field{"zero", &SensorSlope::zero, "where it adds nothing"},
    Field{"low", &SensorSlope::low, "end of what is believed"}, Field{"high", &SensorSlope::high, "the other one"});

template <>
inline constexpr auto kResult<LineErrors> = ResultType(
    "LineErrors", "Errors since the zeros, with what is written.",
    Field{"values", &LineErrors::values, "without those at the zeros"},
    Field{"beyond", &LineErrors::beyond, "of these, with a reading beyond an end of the line"},
    Field{"rms_before_um", in(&LineErrors::line, &Reduction::before_um)},
    Field{"rms_model_um", in(&LineErrors::model, &Reduction::after_um), "with all of the model"},
    Field{"rms_line_um", in(&LineErrors::line, &Reduction::after_um)},
    Field{"reduction_model_percent", in(&LineErrors::model, &Reduction::share, &percent)},
    Field{"reduction_model_sigma_percent", in(&LineErrors::model, &Reduction::sigma, &percent)},
    Field{"reduction_line_percent", in(&LineErrors::line, &Reduction::share, &percent)},
    Field{"reduction_line_sigma_percent", in(&LineErrors::line, &Reduction::sigma, &percent)},
    Field{"largest_before_um", &LineErrors::largest_um}, Field{"largest_model_um", &LineErrors::largest_model_um},
    Field{"largest_line_um", &LineErrors::largest_line_um});

struct WrittenResult {
  std::string control, file, axis, target;
  std::optional<bool> in_sample;
  Simplification found;
};

constexpr auto simplified_to(auto... get) { return in(&WrittenResult::found, get...); }

template <>
inline constexpr auto kResult<WrittenResult> = ResultType(
    "Written", "A model as a line for a control's own temperature compensation.",
    Field{"control", &WrittenResult::control}, Field{"file", &WrittenResult::file}, Field{"axis", &WrittenResult::axis},
    Field{"target", &WrittenResult::target, "column that is compensated"},
    Field{"in_sample", &WrittenResult::in_sample, "whether the model was fitted to these data; null: not known here"},
    Field{"sensors", simplified_to(&Simplification::line, &LinearCompensation::sensors)},
    Field{"increment_um", simplified_to(&Simplification::line, &LinearCompensation::increment, &Increment::um),
          "of the result"},
    Field{"rows", simplified_to(&Simplification::rows), "that the line is fitted to"},
    Field{"runs", simplified_to(&Simplification::runs)},
    Field{"rms_from_model_um", simplified_to(&Simplification::from_model_um),
          "of the model's prediction less the line"},
    Field{"fitted", simplified_to(&Simplification::fitted), "all values, which the line is fitted to"},
    Field{"left_out", simplified_to(&Simplification::left_out),
          "values that choice and slopes did not have: each run, or the last two fifths of one; null: too few"});

}  // namespace ballbar

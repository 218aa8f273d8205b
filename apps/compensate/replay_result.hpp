// What `compensate --on --json` prints.
#pragma once

#include <optional>
#include <string>

#include "ballbar/compensation/compensation_replay.hpp"
#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

struct ReplayedAxisResult {
  ReplayedAxis axis;
  double largest_before_um = 0.0, largest_after_um = 0.0;
  TableOf<std::size_t> rows_held;
};

template <>
struct ResultType<ReplayedAxisResult> {
  using Axis = const ReplayedAxis&;
  static constexpr std::string_view name = "ReplayedAxis";
  static constexpr std::string_view meaning = "An axis before and after it is compensated.";
  static constexpr std::tuple reduced{
      Field{"target", &ReplayedAxis::target, "column that is compensated"},
      Field{"values", [](Axis of) { return of.time_s.size() - 1; }, "since the first, which is left out"},
      Field{"rms_before_um", [](Axis of) { return of.reduction.before_um; }, ""},
      Field{"rms_after_um", [](Axis of) { return of.reduction.after_um; }, ""},
      Field{"reduction_percent", [](Axis of) { return 100.0 * of.reduction.share; }, ""},
      Field{"reduction_sigma_percent", [](Axis of) { return 100.0 * of.reduction.sigma; }, ""},
      Field{"stretch", [](Axis of) { return of.reduction.stretch; }, "values over which what is left stays alike"}};
  static constexpr std::tuple held{
      Field{"most_held_by",
            [](Axis of) {
              return MayLack<std::string>{of.most_held_by.empty() ? std::nullopt : std::optional(of.most_held_by)};
            },
            "column"},
      Field{"rows_limited", &ReplayedAxis::rows_limited, "by the limits"}};
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&ReplayedAxisResult::axis, reduced),
                     std::tuple{Field{"largest_before_um", &ReplayedAxisResult::largest_before_um, ""},
                                Field{"largest_after_um", &ReplayedAxisResult::largest_after_um, ""},
                                Field{"rows_held", &ReplayedAxisResult::rows_held, "by why"}},
                     fields_through(&ReplayedAxisResult::axis, held));
};

struct ReplayResult {
  std::size_t rows = 0;
  std::optional<bool> in_sample;
  TableOf<ReplayedAxisResult> axes;
};

template <>
struct ResultType<ReplayResult> {
  static constexpr std::string_view name = "Replayed";
  static constexpr std::string_view meaning = "A compensation replayed over what was recorded.";
  static constexpr std::tuple fields{
      Field{"rows", &ReplayResult::rows, "of signals"},
      Field{"in_sample", &ReplayResult::in_sample, "whether it was fitted to these data; null: not known here"},
      Field{"axes", &ReplayResult::axes, "by letter"}};
};

}  // namespace ballbar

// What `compensate --on --json` prints.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/compensation/compensation_replay.hpp"
#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

inline double largest_of(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

template <>
inline constexpr auto kResult<ReplayedAxis> = ResultType{"ReplayedAxis", "An axis before and after it is compensated.", std::tuple{
      Field{"target", &ReplayedAxis::target, "column that is compensated"},
      Field{"values", [](const ReplayedAxis& of) { return of.time_s.size() - 1; }, "since the first, which is left out"},
      Field{"rms_before_um", [](const ReplayedAxis& of) { return of.reduction.before_um; }, ""},
      Field{"rms_after_um", [](const ReplayedAxis& of) { return of.reduction.after_um; }, ""},
      Field{"reduction_percent", [](const ReplayedAxis& of) { return 100.0 * of.reduction.share; }, ""},
      Field{"reduction_sigma_percent", [](const ReplayedAxis& of) { return 100.0 * of.reduction.sigma; }, ""},
      Field{"stretch", [](const ReplayedAxis& of) { return of.reduction.stretch; }, "values over which the residual is correlated"},
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

}  // namespace ballbar

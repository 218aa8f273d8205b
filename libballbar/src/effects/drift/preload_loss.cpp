#include <array>

#include "effects/evaluate.hpp"
#include "effects/grids.hpp"

namespace ballbar::catalogue {
namespace {

constexpr double kWithoutKink = 0.999;  // a threshold near the lowest value leaves the whole expansion

// k max(0, u - u_0 - threshold)
struct PreloadLoss {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> signal = rows.inputs[0];
    const T beyond = (signal[i] - zero_of(rows, 0)) - p[1];
    return beyond > T(0.0) ? p[0] * beyond : T(0.0);
  }
};

// Shares of the way up: places of the kink.
std::vector<double> thresholds(const EffectRows& rows, double, double, std::size_t) {
  return shares_of(rise_in(rows.inputs[0]), std::array{0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45,
                                                       0.5,  0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95});
}

double usual_threshold(const EffectRows& rows, double share) {
  return (0.2 + (0.7 - 0.2) * share) * rise_in(rows.inputs[0]);
}

}  // namespace

extern const Effect kPreloadLoss{
    "preload_loss",
    Level::series,
    {.summary = "Preload is lost above a temperature or elongation.",
     .cause = "Expansion uses up the preload of the bearing. Every further kelvin or micrometre becomes clearance.",
     .formula = "gain max(0, u - u0 - threshold), u the signal, u0 its first value",
     .signature = "Residual against the signal has a kink, at the same place while warming and cooling.",
     .confused_with = {"bearing_clearance", "expansion", "play_hysteresis"},
     .separated_by = "Warm up and cool down twice past the kink: it stays in place; a lag or play moves it.",
     .remedy = "Set the preload again, or use springs; keep the spindle below the kink by cooling.",
     .validity =
         "One bearing, one kink, linear on both sides. The kink is at u0 + threshold; compare this value between runs.",
     .source =
         "Huang, Li, Zhao 2022, section 3.3, says that elongation uses up the preload; the kink follows from it."},
    {{"signal", {"degC", "K", "um"}, "temperature of the bearing or axial drift"}},
    {gain_within("gain_um_per_unit", "um/unit", 1000.0, "drift for each K or um of the signal beyond the threshold"),
     {"threshold_unit",
      "unit",
      ParameterKind::shape,
      2.0,
      0.0,
      1000.0,
      {},
      "rise of the signal since the first row, in K or um, at which the preload is gone",
      false,
      ShapeOf::curve,
      thresholds,
      usual_threshold}},
    by_row<2>(PreloadLoss{}),
    false,
    {},
    {.same_as_input = kWithoutKink, .becomes = "expansion", .is_common = true},
};

}  // namespace ballbar::catalogue

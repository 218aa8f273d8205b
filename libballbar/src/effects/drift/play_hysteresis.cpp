#include <array>

#include "effects/evaluate.hpp"
#include "effects/grids.hpp"

namespace ballbar::catalogue {
namespace {

// k (play_w[u] - u) with the play operator p_i = max(u_i - w, min(u_i + w, p_{i-1})), p_0 = u_0.
struct PlayHysteresis {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T* kept) const {
    const std::span<const double> signal = rows.inputs[0];
    T& follower = kept[0];
    if (i == 0) follower = T(0.0);
    const double u = signal[i] - signal[0];
    const T high = u + p[1], low = u - p[1];
    if (follower > high) follower = high;
    if (follower < low) follower = low;
    return p[0] * (follower - u);
  }
};

constexpr double kSameAsExpansion = 0.99;  // play that never gives way holds the whole expansion back and shows no loop

// Shares of the range of the signal, of which half would be stuck.
std::vector<double> half_widths(const EffectRows& rows, double, double, std::size_t) {
  return shares_of(range_in(rows.inputs[0]), std::array{0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45});
}

double usual_half_width(const EffectRows& rows, double share) {
  return (0.05 + (0.2 - 0.05) * share) * range_in(rows.inputs[0]);
}

}  // namespace

extern const Effect kPlayHysteresis{
    "play_hysteresis",
    Level::series,
    {.summary = "Stick-slip at a joint.",
     .cause =
         "Friction holds a joint until the expanding body has pushed far enough. Then the joint slips and follows.",
     .formula = "gain (play[u] - u), play_i = max(u_i - half_width, min(u_i + half_width, play_(i-1))), u since the "
                "first row",
     .signature = "Residual against the signal forms a loop of constant width at any rate of change.",
     .confused_with = {"lagged_expansion", "gradient_bending", "preload_loss"},
     .separated_by = "Warm and cool once fast and once slowly: the loop of a lag shrinks at the slow rate, the loop of "
                     "play does not.",
     .remedy = "Tighten the joint to its torque; guide it so that it slides without sticking; oil it.",
     .validity = "One joint; the rows must include every turning point of the signal.",
     .source = "Play operator of hysteresis models; not from a paper."},
    {{"signal", {"degC", "K", "um"}, "temperature of the body that pushes, or its growth"}},
    {gain_within("gain_um_per_unit", "um/unit", 1000.0, "shift for each K or um that the joint holds back"),
     {"half_width_unit",
      "unit",
      ParameterKind::shape,
      1.0,
      0.0,
      1000.0,
      {},
      "half the width of the loop, in K or um of the signal",
      false,
      ShapeOf::curve,
      half_widths,
      usual_half_width}},
    by_row<2, 1>(PlayHysteresis{}),
    false,
    {},
    {.same_as_input = kSameAsExpansion, .becomes = "expansion", .is_common = true},
};

}  // namespace ballbar::catalogue

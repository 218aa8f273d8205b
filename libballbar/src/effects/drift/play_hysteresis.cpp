#include "effects/catalogue.hpp"
#include "effects/evaluate.hpp"

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

}  // namespace

const Effect kPlayHysteresis{
    "play_hysteresis",
    Level::series,
    {.summary = "Stick and slip at a joint.",
     .cause = "A joint sticks by friction until the growing body has pushed far enough, then slips along behind it.",
     .formula = "gain (play[u] - u), play_i = max(u_i - half_width, min(u_i + half_width, play_(i-1))), u since the "
                "first row",
     .signature = "Residual against the signal is a loop of constant width, however slow or fast the signal changes.",
     .confused_with = {"lagged_expansion", "gradient_bending", "preload_loss"},
     .becomes = "expansion",
     .separated_by =
         "Warm and cool once fast and once slowly: the loop of a lag shrinks when slow, that of play stays.",
     .remedy = "Tighten the joint to its torque; guide it so that it can slide without sticking; oil it.",
     .validity = "One joint; the rows must not miss a turning point of the signal.",
     .source = "The play operator of hysteresis models; no paper's equation."},
    {{"signal", {"degC", "K", "um"}, "temperature of the body that pushes, or its growth"}},
    {{"gain_um_per_unit",
      "um/unit",
      ParameterKind::gain,
      0.0,
      -1000.0,
      1000.0,
      {},
      "shift for each K or um that the joint holds back"},
     {"half_width_unit",
      "unit",
      ParameterKind::shape,
      1.0,
      0.0,
      1000.0,
      {},
      "half the width of the loop, in K or um of the signal"}},
    by_row<2, 1>(PlayHysteresis{}),
};

}  // namespace ballbar::catalogue

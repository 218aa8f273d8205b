#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// - c V^2, V in m/min
struct DynamicContraction {
  template <class T>
  void operator()(const EffectRows& rows, const T* p, T* out) const {
    const std::span<const double> feed = rows.inputs[0];
    for (std::size_t i = 0; i < feed.size(); ++i) out[i] = p[0] * (-1e-6 * feed[i] * feed[i]);
  }
};

}  // namespace

extern const Effect kDynamicContraction{
    "dynamic_contraction",
    Level::recording,
    {.summary = "The circle shrinks with the square of the feed.",
     .cause = "Axes that follow with a time constant tau cut the corner: the path's radius is smaller by "
              "(tau V)^2 / (2 R). Filters of the commanded path do the same.",
     .formula = "- contraction V^2, V in m/min",
     .signature = "The radius is smaller at high feed, the same in both directions.",
     .confused_with = {"circle", "bar_temperature"},
     .separated_by = "Two feeds in the order A-B-B-A, so that warming is not taken for the feed. One feed shows the "
                     "radius only.",
     .remedy = "Feed-forward, higher gain of the position loops, or a lower feed for finishing.",
     .validity = "Linear axes; one radius: at another radius the contraction is different. Higher feeds meet "
                 "limits of acceleration.",
     .source = "Amplitude of a first-order lag at the frequency of the circle, first term; no paper's equation."},
    {feed_input()},
    {{"contraction_um_per_m2_min2",
      "um/(m/min)^2",
      ParameterKind::gain,
      0.0,
      -1000.0,
      1000.0,
      {},
      "loss of radius at 1 m/min"}},
    evaluated_by<1>(DynamicContraction{}),
    false,
    {Motion::linear_axes},
};

}  // namespace ballbar::catalogue

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// - c V^2, V in m/min
struct DynamicContraction {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> feed = rows.inputs[0];
    return p[0] * (-1e-6 * feed[i] * feed[i]);
  }
};

}  // namespace

extern const Effect kDynamicContraction{
    "dynamic_contraction",
    Level::recording,
    {.summary = "The radius shrinks with the square of the feed.",
     .cause = "Axes that follow with a time constant tau cut the corner: the radius of the path is smaller by (tau "
              "V)^2 / (2 R). Filters of the commanded path have the same effect.",
     .formula = "- contraction V^2, V in m/min",
     .signature = "The radius is smaller at high feed, the same in both directions.",
     .confused_with = {"circle", "bar_temperature"},
     .separated_by =
         "Measure two feeds in the order A-B-B-A to separate the feed from warming. One feed shows only the radius.",
     .remedy = "Use feed-forward, a higher gain of the position loops, or a lower feed for finishing.",
     .validity = "Linear axes; one radius, because another radius has another contraction. At high feeds the "
                 "acceleration is limited.",
     .source = "Amplitude of a first-order lag at the frequency of the circle, first term; not from a paper."},
    {feed_input()},
    {gain_within("contraction_um_per_m2_min2", "um/(m/min)^2", 1000.0, "loss of radius at 1 m/min")},
    by_reading<1>(DynamicContraction{}),
    false,
    {Motion::linear_axes},
};

}  // namespace ballbar::catalogue

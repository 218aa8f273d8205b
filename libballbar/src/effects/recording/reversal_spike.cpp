#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// h exp(- d / w), d the angle travelled since the axis reversed last; h_pos at its + end, h_neg at its - end.
struct ReversalSpike {
  Axis axis;

  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    using std::exp;
    const std::span<const double> angle_rad = rows.inputs[0], direction = rows.inputs[1];
    const auto [since_deg, positive_end] = last_reversal(axis, angle_rad[i], direction[i]);
    return (positive_end ? p[0] : p[1]) * exp(-since_deg / p[2]);
  }
};

Effect reversal_spike(Axis axis) {
  const bool a = axis == Axis::A;
  return {
      a ? "reversal_spike_a" : "reversal_spike_b",
      Level::recording,
      {.summary = a ? "Axis A sticks for a moment when it reverses, at 0 and 180 deg."
                    : "Axis B sticks for a moment when it reverses, at 90 and 270 deg.",
       .cause = "Friction changes sign when the axis reverses, and the control needs a moment to reverse the torque. "
                "Until then the axis stands still and the path bulges.",
       .formula = "height exp(- d / width), d the angle travelled since the reversal; one height for each end",
       .signature =
           "A short outward peak right after the reversal, on the opposite side of it in the opposite direction.",
       .on_parts = a ? "An interpolated circle has a mark of that height right after 0 and 180 deg: a groove in a "
                       "milled bore, a ridge on a boss. Bored and drilled holes are free of it, because it fades "
                       "before the axis stands still."
                     : "An interpolated circle has a mark of that height right after 90 and 270 deg: a groove in a "
                       "milled bore, a ridge on a boss. Bored and drilled holes are free of it, because it fades "
                       "before the axis stands still.",
       .confused_with = {a ? "backlash_a" : "backlash_b", "vibration"},
       .separated_by = "Measure two feeds: a spike grows higher or wider with the feed, a step of backlash does not. "
                       "With both directions it appears on both sides of the reversal.",
       .remedy = "Use the control's friction compensation (quadrant error compensation); check lubrication and preload "
                 "of the guideways.",
       .validity = "Linear axes; a spike with one exponential decay. Some spikes rise before they decay.",
       .source =
           "Description of the form, not from a paper; heights as AF_REVERSAL_SPIKES_POS and _NEG, outwards positive."},
      {angle_input(), direction_input()},
      {gain_within("height_pos_um", "um", 1000.0, "height after the reversal at the + end", "pos"),
       gain_within("height_neg_um", "um", 1000.0, "height after the reversal at the - end", "neg"),
       {"width_deg",
        "deg",
        ParameterKind::shape,
        3.0,
        0.2,
        9.0,
        {0.5, 1.0, 2.0, 4.0},
        "angle over which it decays to 37 %"}},
      by_reading<3>(ReversalSpike{axis}),
      false,
      {Motion::linear_axes},
      {.error_fit = ErrorFit::at_reversals, .reversal_deg = a ? 0.0 : 90.0},
  };
}

}  // namespace

extern const Effect kReversalSpikeA = reversal_spike(Axis::A);
extern const Effect kReversalSpikeB = reversal_spike(Axis::B);

}  // namespace ballbar::catalogue

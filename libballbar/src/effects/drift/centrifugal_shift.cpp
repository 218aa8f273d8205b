#include "effects/drift_rows.hpp"
#include "effects/evaluate.hpp"

namespace ballbar::catalogue {
namespace {

// k n^p
struct CentrifugalShift {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    return p[0] * power_of_speed(rows.inputs[0][i], p[1]);
  }
};

}  // namespace

extern const Effect kCentrifugalShift{
    "centrifugal_shift",
    Level::series,
    {.summary = "The rotor shifts with speed, without delay.",
     .cause = "Centrifugal load presses balls and rings outwards and moves the rotor within the bearing clearance.",
     .formula = "gain n^exponent, n in krpm",
     .signature = "A jump at every change of speed that reverses at once on a stop.",
     .confused_with = {"speed_heating", "cooling_asymmetry", "viscosity_feedback"},
     .separated_by = "Read every few seconds after a stop: this shift disappears at once, heat decays over minutes.",
     .remedy = "Measure and compensate at working speed; check the preload of the bearings.",
     .validity = "Shift within the bearing clearance; the bearing does not change as it warms.",
     .source = "Huang, Li, Zhao 2022, section 3.4: the lift was measured to go roughly with the square of the speed."},
    {{"speed", {"rpm"}, "speed of the spindle"}},
    {gain_within("gain_um_per_krpm_p", "um/krpm^p", 1000.0, "shift at 1000 rpm"),
     {"exponent", "1", ParameterKind::shape, 2.0, 1.0, 3.0, {1.0, 1.5, 2.0, 2.5, 3.0}, "p, of the speed", true}},
    by_row<2>(CentrifugalShift{}),
    false,
    {},
    {.is_common = true, .explains = {{SpindleCause::centrifugal}}, .predictor = {{PredictorKind::source, {{2.0}}}}},
};

}  // namespace ballbar::catalogue

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// - L alpha (T_bar - 20 degC); ppm of mm are nm
struct BarTemperatureOfRecording {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> radius_mm = rows.inputs[0], bar_degC = rows.inputs[1];
    return p[0] * (-1e-3 * radius_mm[i] * (bar_degC[i] - 20.0));
  }
};

}  // namespace

extern const Effect kBarTemperatureOfRecording{
    "bar_temperature",
    Level::recording,
    {.summary = "The bar is not at 20 degC and misreads the distance.",
     .cause = "A warm bar is longer. At the same distance between the balls its transducer is pushed in further, so "
              "the reported length is too short.",
     .formula = "- L0 expansion (T_bar - 20 degC)",
     .signature = "The same radius error all round, larger in warmer tests.",
     .confused_with = {"circle", "dynamic_contraction"},
     .separated_by = "Record at two temperatures of the bar on the same machine, or check the bar on its calibrator "
                     "before and after.",
     .remedy = "Let the bar adapt on the machine before the test, enter its temperature, do not hold it in the hand.",
     .validity = "Readings not corrected for the bar temperature; steel has 11.5 ppm/K, the certificate states the "
                 "bar's own value.",
     .source = "Free expansion; not from a paper."},
    {radius_input(), bar_input()},
    {gain_within("expansion_ppm_per_K", "ppm/K", 100.0, "expansion coefficient of the bar")},
    by_reading<1>(BarTemperatureOfRecording{}),
};

}  // namespace ballbar::catalogue

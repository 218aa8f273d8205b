#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// - L alpha (T_bar - 20 degC); ppm of mm are nm
struct BarTemperatureOfRecording {
  template <class T>
  void operator()(const EffectRows& rows, const T* p, T* out) const {
    const std::span<const double> radius_mm = rows.inputs[0], bar_degC = rows.inputs[1];
    for (std::size_t i = 0; i < radius_mm.size(); ++i) out[i] = p[0] * (-1e-3 * radius_mm[i] * (bar_degC[i] - 20.0));
  }
};

}  // namespace

extern const Effect kBarTemperatureOfRecording{
    "bar_temperature",
    Level::recording,
    {.summary = "The bar is not at 20 degC, so that it reads the distance wrongly.",
     .cause = "A warm bar is longer: at the same distance of the balls its transducer is pushed in further, and the "
              "length it reports is too short.",
     .formula = "- L0 expansion (T_bar - 20 degC)",
     .signature = "A radius that is off by the same amount all round, more in warmer tests.",
     .confused_with = {"circle", "dynamic_contraction"},
     .separated_by = "Recordings at two temperatures of the bar with the same machine, or the calibrator of the bar "
                     "before and after.",
     .remedy = "Let the bar lie on the machine before the test, enter its temperature, keep hands from it.",
     .validity = "Readings that were not yet corrected for the bar's temperature; steel 11.5 ppm/K, the bar's "
                 "certificate says its own.",
     .source = "Free expansion; no paper's equation."},
    {radius_input(), bar_input()},
    {{"expansion_ppm_per_K", "ppm/K", ParameterKind::gain, 0.0, -100.0, 100.0, {}, "expansion coefficient of the bar"}},
    evaluated_by<1>(BarTemperatureOfRecording{}),
};

}  // namespace ballbar::catalogue

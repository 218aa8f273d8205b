#include "effects/temperature_at_start.hpp"

#include "effects/evaluate.hpp"

namespace ballbar {
namespace {

// k T_0
struct TemperatureAtStart {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t, const T* p, T*) const {
    return T(rows.inputs[0][0]) * p[0];
  }
};

}  // namespace

const std::shared_ptr<const Effect>& temperature_at_start() {
  static const auto effect = std::make_shared<const Effect>(
      Effect{"start",
             Level::series,
             {.summary = "Temperature of the machine at the start of a run.", .formula = "gain T0"},
             {{"temperature", {"degC", "K"}, "temperature in the first row"}},
             {gain_within("gain_um_per_K", "um/K", 1000.0, "error for each kelvin at the start")},
             by_row<1>(TemperatureAtStart{}),
             false,
             {},
             {.predictor = {{PredictorKind::start, {}}}}});
  return effect;
}

}  // namespace ballbar

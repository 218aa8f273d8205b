#include "effects/run_effects.hpp"

#include "effects/evaluate.hpp"

namespace ballbar {
namespace {

bool is_of(const EffectRows& rows, double run) {
  return run > static_cast<double>(rows.run) - 0.5 && run < static_cast<double>(rows.run) + 0.5;
}

double value_of(double parameter) { return parameter; }
template <class T>
double value_of(const T& parameter) {
  return parameter.a;
}

// k in the run, else 0; p = k, run
struct OffsetOfRun {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t, const T* p, T*) const {
    return is_of(rows, value_of(p[1])) ? p[0] : T(0.0);
  }
};

// k exp(-(t - t_0) / tau) in the run, else 0; p = k, tau, run
struct StartOfRun {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    using std::exp;
    if (!is_of(rows, value_of(p[2]))) return T(0.0);
    return p[0] * exp(-(rows.time_s[i] - rows.time_s[0]) / p[1]);
  }
};

// k T_0
struct TemperatureAtStart {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t, const T* p, T*) const {
    return T(rows.inputs[0][0]) * p[0];
  }
};

Parameter number_of_run() {
  return {"run", "1", ParameterKind::shape, 0.0, 0.0, 1e6, {}, "number of the run: 0, 1 ...", true, ShapeOf::recording};
}

}  // namespace

const std::shared_ptr<const Effect>& offset_of_run() {
  static const auto effect = std::make_shared<const Effect>(
      Effect{"offset_of_run",
             Level::series,
             {.summary = "Zero of a run: no two set-ups are equal.", .formula = "gain"},
             {},
             {gain_within("gain_um", "um", 1e6, "zero of the run minus that of the first run"), number_of_run()},
             by_row<2>(OffsetOfRun{}),
             true,
             {},
             {.is_base = true, .of_set_up = true}});
  return effect;
}

const std::shared_ptr<const Effect>& start_of_run() {
  static const auto effect = std::make_shared<const Effect>(
      Effect{"start_of_run",
             Level::series,
             {.summary = "Remaining heat from before the run.", .formula = "gain exp(-t / tau)"},
             {},
             {gain_within("gain_um", "um", 1e4, "in the first row"),
              {"time_constant_s",
               "s",
               ParameterKind::shape,
               3600.0,
               300.0,
               36000.0,
               {900.0, 3600.0, 10800.0},
               "time constant of the decay"},
              number_of_run()},
             by_row<3>(StartOfRun{}),
             true,
             {},
             {.is_base = true, .of_set_up = true}});
  return effect;
}

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

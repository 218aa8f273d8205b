// Effects to hide and models to hide them from, as tracks.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "plan.hpp"

namespace ballbar::verdicts {

struct ParameterTruth {
  std::string name;  // as the catalogue calls it
  double value = 0.0;
  bool is_gain = false;
};

struct Hidden {
  std::string effect;                      // its name in the catalogue
  std::vector<Quantity> inputs;            // in the order of the effect's
  std::vector<ParameterTruth> parameters;  // the gain first; only those that are free
  Track unit;                              // what it adds for a gain of 1
  double at_once_per_K = 0.0;              // of it, for each K of noise in its sensors; 0 behind a lag
};

// Names of the effects that are hidden.
inline constexpr std::array<std::string_view, 10> kHidden{
    "expansion",    "lagged_expansion", "centrifugal_shift", "cooling_asymmetry", "viscosity_feedback",
    "load_heating", "gradient_bending", "bearing_rings",     "preload_loss",      "play_hysteresis"};

// On columns that suit, evenly; shapes off any grid, time constants from two rows to half the span, evenly in the
// logarithm. The gain is 1.
Hidden drawn_effect(std::string_view effect, const Plan& plan, double row_s, Chance& chance);

// What an effect with these parameters adds on a plan, its gain included. A temperature at which something happens is
// that of `first`, the plan on which the parameters were drawn: its rise there.
Track added_by(const Hidden& hidden, const Plan& plan, const Plan& first);

// What the user's model has right, gain and time constant free.
struct Base {
  std::string effect;  // empty: a constant alone
  Quantity input = Quantity::speed;
  double gain = 0.0;
  double time_constant_s = 0.0;  // 0: none
  double exponent = 0.0;         // of the speed, held; 0: none
  Track track;                   // with the gain
};

// Mostly friction heat; also a growth with the housing, a lag behind the room, or a constant alone.
Base drawn_base(const Plan& plan, double range_um, Chance& chance);
Track unit_track(const Base& base, const Plan& plan, double time_constant_s);

// Derivatives of the model by its constant and its free parameters, at the rows: n by 1 to 3.
Eigen::MatrixXd jacobian(const Base& base, const Plan& plan, const std::vector<double>& time_s);

}  // namespace ballbar::verdicts

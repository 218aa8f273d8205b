// What an effect adds, written anew for the study: on true tracks, second by second, by formulas of the documentation.
#pragma once

#include "plan.hpp"

namespace ballbar::verdicts {

// x' = (u - x) / tau from x(0) = u(0), exact for an input that holds its value from second to second.
Track low_pass(const Track& input, double time_constant_s);

Track power_of_speed(const Track& speed_rpm, double exponent);  // of krpm
Track rise(const Track& track);                                 // since the first second
Track difference(const Track& one, const Track& other);

// Low pass of n^exponent with one time constant while the spindle turns and another while it stands.
Track heat_with_two_lags(const Track& speed_rpm, double exponent, double turning_s, double at_rest_s);

// n exp(-loss (T - T0)), n in krpm
Track thinning_friction(const Track& speed_rpm, const Track& temperature, double loss_per_K);

// Growth of an outer raceway of radius 37.66 mm less that of an inner one of 27.34 mm, both of 13.6 ppm/K, um.
Track ring_growth(const Track& inner, const Track& outer);

Track beyond(const Track& track, double threshold);      // max(0, rise - threshold)
Track held_back(const Track& track, double half_width);  // play[rise] - rise

double range(const Track& track);

}  // namespace ballbar::verdicts

// Starts to try for one shape parameter on given data.
#pragma once

#include <vector>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

// The parameter's own grid; for the place of a kink and the width of a loop shares of how far the signal goes; for what
// repeats (period_s, frequency_Hz, pitch_mm) instead every half of what the length
// of the data can resolve, at most `most` values, no frequency above half the rate of the rows and no pitch below the
// grid's first: a sinusoid is found only from a start that near. Values outside
// [lower, upper] are left out.
std::vector<double> shape_grid(const Effect& effect, std::size_t parameter, const EffectRows& rows, double lower,
                               double upper, std::size_t most);

}  // namespace ballbar

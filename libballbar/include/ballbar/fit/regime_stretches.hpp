// The regimes of a warm-up as stretches of time.
#pragma once

#include <vector>

#include "ballbar/fit/residual.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Rows of one regime (residual.hpp) that follow on each other.
struct RegimeStretch {
  Regime regime = Regime::standstill;
  double from_s = 0.0, to_s = 0.0;  // its first row; the first row of the next stretch, or the last of all
};

// By the first column of role speed; none without one, or where its speed is never known.
std::vector<RegimeStretch> regime_stretches(const Series& data);

}  // namespace ballbar

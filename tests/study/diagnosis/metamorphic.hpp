// Changes of a data set that should not change what is said of it.
#pragma once

#include <cstdint>

#include "outcome.hpp"

namespace ballbar::study {

enum class Change {
  fewer_rows,   // 30 % of the rows, drawn, are not there
  resampled,    // 60 s instead of 15 s: every fourth row
  renamed,      // other names of the columns, units kept
  noise_input,  // one more temperature, of noise
  turned        // the columns in the opposite order
};

// right: the same verdict, and the same effects named. Every third set has nothing hidden, the others one effect of
// d = 10.
Outcome outcome_of_change(Change change, std::uint64_t seed);

}  // namespace ballbar::study

// Data sets in which something is hidden that is not in the catalogue that is searched.
#pragma once

#include <string_view>

#include "made.hpp"

namespace ballbar::verdicts {

enum class Outside {
  driven,      // by logged inputs, in a form that is in no catalogue
  of_time,     // a curve of nothing
  left_out,    // an effect that the search leaves out
  bar,         // a bar of 20 cells, heated by friction at one end and cooled at the other
  not_logged,  // an effect of a temperature that is not in the data
};

// d is drawn from 15 to 40. No effect of the catalogue, alone beside the base model, comes nearer than d = 6.
Made made_outside(Outside kind, std::string_view stream, std::uint64_t seed);

// Mean temperature of the bar's cells since the start.
Track bar_of_cells(const Plan& plan, double diffusion_s, double heat_per_s, double cooling_per_s);

}  // namespace ballbar::verdicts

// Periodic effects and the sampling of the rows: a cycle of less than two rows is aliased to a slower one.
#pragma once

#include <span>

#include "ballbar/effects/effect.hpp"
#include "ballbar/model/model.hpp"

namespace ballbar {

// Half the usual rate of rows; infinite where time never goes on.
double highest_Hz(std::span<const double> time_s);

// Of a shape with this value; 0: it is nothing that repeats.
double frequency_Hz(const Parameter& parameter, double value);

// The usual period of what repeats, that which the effect starts with; 0: nothing repeats.
double usual_period_s(const Effect& effect);

// Whether rows of this rate show the usual period. Where they do not, a longer one that fits would as likely be the
// usual one in disguise.
bool is_resolved(const Effect& effect, double highest_Hz);

// The terms with bounds of their free shapes, and starts, that rows of this rate show. A shape that is stated outside
// them stays free as it was, and so does one of which they leave nothing.
Model with_resolved_periods(Model model, double highest_Hz);
Term with_resolved_periods(Term term, double highest_Hz);

}  // namespace ballbar

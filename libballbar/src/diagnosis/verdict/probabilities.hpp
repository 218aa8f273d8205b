// What a posterior says of columns, and of what may stand in the place of an effect.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

// Columns by P that something which reads them is missing, from P = 0.5; the most probable first.
std::vector<Driver> drivers_of(const Problem& problem, const Posterior& posterior);

// The credible set of a single effect: identities that hold 95 % of its probability, the most probable first.
std::vector<std::size_t> credible_set(const SinglePosterior& effect);

// ln of how much more likely the readings are with any effect or other value than with none of them.
double log_bayes_factor_of_any(const Posterior& posterior);

}  // namespace ballbar

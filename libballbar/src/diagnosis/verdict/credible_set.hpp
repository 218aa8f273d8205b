// Probabilities of columns and of alternatives to an effect, from a posterior.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

// Columns with the probability that an effect of theirs is missing, if P >= 0.5; the most probable first.
std::vector<Driver> drivers_of(const Problem& problem, const Posterior& posterior);

// The credible set of a single effect: the identities with this share of its probability, the most probable first.
std::vector<std::size_t> credible_set(const SinglePosterior& effect, double credible = Tuning{}.credible);

}  // namespace ballbar

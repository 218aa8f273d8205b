// Whether an open run may still be decided.
#pragma once

#include <string>

#include "ballbar/diagnosis/follow/follow.hpp"

namespace ballbar {

// The threshold from which a look may name an effect.
double least_log_bayes_factor();

// Why, by the last look, nothing will be decided by the planned end; empty: a decision is possible.
std::string why_it_stays_open(const FollowState& state);

}  // namespace ballbar

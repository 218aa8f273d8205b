// Whether a run that is open may be decided yet.
#pragma once

#include <string>

#include "ballbar/diagnosis/follow/follow.hpp"

namespace ballbar {

// From which on a look may name something.
double least_log_bayes_factor();

// Why, at the last look, nothing would be decided by the planned end; empty where it may be.
std::string why_it_stays_open(const FollowState& state);

}  // namespace ballbar

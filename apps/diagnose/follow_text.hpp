// The output of `diagnose --follow`: one row per look, then the decision.
#pragma once

#include <string>

#include "ballbar/diagnosis/follow/follow.hpp"

namespace ballbar {

void print_follow_heading(const std::string& name, const std::string& target);

// The last look.
void print_look(const FollowState& state, bool json);

struct NextStep {
  std::string command;  // the next command; empty: none
  std::string hint;     // a sentence, if the next step is not a command; or empty
};
void print_outcome(const FollowState& state, const NextStep& next, bool json);

}  // namespace ballbar

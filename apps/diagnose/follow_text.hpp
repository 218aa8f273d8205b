// What `diagnose --follow` prints: a row a look, then what is decided.
#pragma once

#include <string>

#include "ballbar/diagnosis/follow/follow.hpp"

namespace ballbar {

void print_follow_heading(const std::string& name, const std::string& target);

// The last look.
void print_look(const FollowState& state, bool json);

struct NextStep {
  std::string command;  // to paste; empty: none
  std::string hint;     // what to do where no command does it, a sentence; or empty
};
void print_outcome(const FollowState& state, const NextStep& next, bool json);

}  // namespace ballbar

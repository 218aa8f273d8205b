// Counts of a cell by stage, with Wilson 95 % intervals.
#pragma once

#include <string>
#include <vector>

#include "next_test/loop.hpp"

namespace ballbar::next_test {

std::string heading();
std::string rows_of(const std::string& cell, const std::string& plan, const std::vector<Looped>& sets);

// Of all tests whose design promised a probability: how many were right after them.
std::string reliability(const std::vector<Looped>& sets);

// A set, one line a stage.
std::string lines_of(const Looped& set);

}  // namespace ballbar::next_test

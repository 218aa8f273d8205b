// Counts of a cell, printed with Wilson 95 % intervals.
#pragma once

#include <string>
#include <vector>

#include "cells.hpp"

namespace ballbar::verdicts {

struct Share {
  double low = 0.0, high = 1.0;
};
Share wilson(std::size_t count, std::size_t of);

std::string heading();
std::string row_of(const Cell& cell, const std::vector<Judged>& sets);

// Of all sets together: what is true of effects by the probability that is stated of them.
std::string reliability(const std::vector<Judged>& sets);

// Of all sets together: how many 95 % intervals hold the truth.
std::string coverage(const std::vector<Judged>& sets);

}  // namespace ballbar::verdicts

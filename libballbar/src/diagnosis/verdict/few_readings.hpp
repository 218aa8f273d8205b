// A few readings, as taken by hand: a second opinion that needs no prior and no noise with a memory.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/posterior/variant.hpp"

namespace ballbar {

// The subset of one or two columns that explains the readings best beside the model, by least squares and Schwarz's
// criterion n ln(RSS / n) + k ln n, if no subset without all of its columns comes within 6 of it; empty: none does.
std::vector<std::string> clear_subset(const Problem& problem, const Variant& variant);

}  // namespace ballbar

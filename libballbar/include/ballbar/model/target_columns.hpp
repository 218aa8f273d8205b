// The columns that a model is to explain.
#pragma once

#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// Throws Error as expect_suits does for targets ("target: expected ..."): none, one twice, one that the data do not
// have, with the nearest; and for one that is not in um, in which all effects are.
void expect_explainable(const std::vector<std::string>& targets, const Series& data);

}  // namespace ballbar

// What of a log was not used, which is said first.
#pragma once

#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "diagnosis/posterior/problem.hpp"

namespace ballbar {

// Columns that change and that no effect of the search and no term of the model reads.
std::vector<ColumnNotSearched> columns_not_searched(const Problem& problem, const Model& model);

std::vector<Saturated> saturated_sensors(const Problem& problem);

}  // namespace ballbar

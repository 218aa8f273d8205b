// The sets of effects that the data leave in question: fitted, the most likely first.
#pragma once

#include <vector>

#include "diagnosis/search/null_model.hpp"
#include "diagnosis/search/subset_fits.hpp"

namespace ballbar {

// Every set worth a look by its likelihood on the grid, fitted with its shapes free; those that share effects with the
// best one anew from where that has them, in the place of each of its effects the others, and it without each. What
// draws the same curve as another with more shapes stands before it. The others sorted by 2 ln L less the thresholds;
// empty where none can be fitted.
std::vector<SubsetFit> competing_subsets(const SubsetFits& now, const NullModel& null_model);

// Whether the data leave open which of the two it is: less than 6 of 2 ln L less thresholds apart, 12 for sets of
// three, of which there are far more; or so near in 2 ln L that thresholds alone would decide.
bool is_open_between(const SubsetFit& best, const SubsetFit& other);

}  // namespace ballbar

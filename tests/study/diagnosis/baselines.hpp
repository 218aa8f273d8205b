// What a user would do without this toolkit: four usual ways to select columns, on the same catalogue, shapes on their
// grid, all of them with white noise.
//
//   greedy_f    forward selection: the signature with the largest fall of the RMSE, as long as its F-test has
//               p < 0.01
//   subset_bic  the set of up to three effects with the least BIC, n ln(RSS) + k ln n
//   greedy_aic  forward selection while AIC falls, n ln(RSS) + 2 k
//   lasso       every column of the catalogue, lambda by cross-validation (5 stretches of time, the largest within one
//               standard error of the best); an effect is selected where one of its coefficients is not 0
//
// k counts gains and free shapes. Selected is what a user would then believe to be there. At most six effects are
// added.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "data_set.hpp"

namespace ballbar::study {

constexpr std::array<std::string_view, 4> kBaselines{"greedy F", "subset BIC", "greedy AIC", "lasso CV"};

// In the order of kBaselines. A step is searched at 7 onsets.
std::array<std::vector<BoundEffect>, 4> baselines(const DataSet& set);

}  // namespace ballbar::study

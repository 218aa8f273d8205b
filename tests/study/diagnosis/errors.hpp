// Whether the error falls as far as it can once what was found is added.
#pragma once

#include <vector>

#include "data_set.hpp"

namespace ballbar::study {

struct Errors {
  double training = 0.0;    // RMSE of the model with what was added, over that of the noise in the data
  double other_duty = 0.0;  // RMSE on another duty cycle (with noise), over that of the true model fitted to the same
                            // data
};

// Of a set on the rich record whose hidden effects are of the catalogue.
Errors errors_of(const DataSet& set, const std::vector<BoundEffect>& added);

}  // namespace ballbar::study

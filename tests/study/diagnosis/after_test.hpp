// The proposed test is done, and the data are diagnosed again.
#pragma once

#include <optional>

#include "data_set.hpp"

namespace ballbar::study {

// The data and, 12 h later, the test that next_tests() puts first: its inputs as planned, the truth and new noise on
// them, the set-up new (an offset, and in the model a step at the test's start). Nothing where no test is proposed.
std::optional<DataSet> after_proposed_test(const DataSet& set, const Diagnosis& found, Random& random);

}  // namespace ballbar::study

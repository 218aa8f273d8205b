// What a residual goes with that no effect of the catalogue explains.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "diagnosis/search/subset_fits.hpp"

namespace ballbar {

// Effects driven by an input that, each alone beside the model, lower the held-out RMSE to less than 70 % of what it
// was; the lowest first, at most 4. `fold`: of every row fitted. None of them is claimed to be the cause.
std::vector<Candidate> associations(const SubsetFits& now, const Noise& noise, const std::vector<std::size_t>& fold);

}  // namespace ballbar

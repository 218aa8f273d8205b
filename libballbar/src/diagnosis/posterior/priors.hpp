// Priors of identities and of their shapes.
#pragma once

#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "diagnosis/evidence/logged_inputs.hpp"
#include "diagnosis/posterior/problem.hpp"
#include "diagnosis/signatures/signature_library.hpp"

namespace ballbar {

// ln pi of each family, given that one is missing. On a series columns are alike, and so are the effects of one column;
// all effects of several columns together have `pairs`, inputs in any form `forms`; a jump counts as one more column.
// On recordings effects are alike, and so are the columns of an effect.
std::vector<double> log_priors_of_identities(const SignatureLibrary& library, Level level, const Tuning& tuning);

// ln of the prior of each signature within its family: those without a lag have `at_once` together, all
// others are alike; -infinity: a lag that the sampling explains.
std::vector<double> log_priors_of_shapes(const SignatureLibrary& library, const LoggedInputs& logged,
                                         const Tuning& tuning);

// Whether the lags of the effect are so short that the sampling of a logger could cause them, and the catalogue has the
// effect without a lag; or whether it is a shift of the clock by as little.
bool is_without_its_lag(const SignatureLibrary& library, const LoggedInputs& logged, const BoundEffect& bound,
                        const std::vector<double>& point, const Tuning& tuning);

}  // namespace ballbar

// A diagnosis that looks at some covariances alone: for many of the same kind.
#pragma once

#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "diagnosis/evidence/covariance.hpp"

namespace ballbar {

// As diagnose, with the noise, and the slow curve, one of these; none: any.
Diagnosis diagnosis_at(const Model& model, const Series& data, std::size_t target, const DiagnosisOptions& options,
                       const std::vector<Covariance>& covariances);

}  // namespace ballbar

// The two steps of a diagnosis: the posterior and the verdict.
#pragma once

#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "diagnosis/posterior/inference.hpp"
#include "noise/linear_filter.hpp"

namespace ballbar {

// The posterior with the catalogue of the options and these stated terms. covariances: noise and slow curve to use;
// empty: all.
Inference inference_of(const Model& model, const Series& data, std::size_t target, const DiagnosisOptions& options,
                       const std::vector<Term>& terms = {}, const std::vector<Covariance>& covariances = {});

// The diagnosis from the posterior, which must be of the same model, data and options. Requested sets are appended to
// those of the posterior.
Diagnosis diagnosis_of(Inference& inference, const Model& model, const Series& data, std::size_t target,
                       const DiagnosisOptions& options);

}  // namespace ballbar

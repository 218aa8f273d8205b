// The two steps of a diagnosis: the posterior, and what is decided of it.
#pragma once

#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "diagnosis/posterior/inference.hpp"
#include "noise/noise_grid.hpp"

namespace ballbar {

// The posterior with the catalogue of the options, and with these terms as they are stated. covariances: of the noise,
// and the slow curve; none: any.
Inference inference_of(const Model& model, const Series& data, std::size_t target, const DiagnosisOptions& options,
                       const std::vector<Term>& terms = {}, const std::vector<Covariance>& covariances = {});

// What the posterior says. It is of that model, these data and options. Sets that are asked for are put behind its own.
Diagnosis diagnosis_of(Inference& inference, const Model& model, const Series& data, std::size_t target,
                       const DiagnosisOptions& options);

}  // namespace ballbar

// Effects of a model that other effects explain better. Each effect becomes a hypothesis again when the model grows.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// An effect that other effects replace: a diagnosis of the model without it names the others and not this one.
struct Replacement {
  std::size_t term = 0;  // of the model
  std::string label;     // of that term
  double p = 0.0;        // probability that it is missing from the model without it
  Diagnosis without;     // of the model without it; `named` holds the others
};

// terms: indices of the terms to examine, one by one. Base effects and terms with all parameters held are skipped.
// Throws Error as diagnose() does.
std::vector<Replacement> replacements(const Model& model, std::span<const std::size_t> terms, const Series& data,
                                      std::size_t target, const DiagnosisOptions& options);

}  // namespace ballbar

// Effects of a model that others explain better: each is a hypothesis again once the model has grown.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// An effect that stood in for others: without it the data name these, and not it.
struct Replacement {
  std::size_t term = 0;  // of the model
  std::string label;     // of that term
  double p = 0.0;        // that it is missing from the model without it
  Diagnosis without;     // of the model without it: `named` are the others
};

// terms: those that are asked, one by one. The base of a model and what is all held are passed over. Throws Error as
// diagnose.
std::vector<Replacement> replacements(const Model& model, std::span<const std::size_t> terms, const Series& data,
                                      std::size_t target, const DiagnosisOptions& options);

}  // namespace ballbar

// The steps of an effect test, for callers that store intermediate results.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/revision/revision.hpp"
#include "diagnosis/posterior/inference.hpp"

namespace ballbar {

// Figures of a fit as the ledger has them.
// fit: of the model to all rows.
LedgerRow row_of(const Fit& fit, const Model& model, const Series& data, std::size_t target);

// A model fitted to all rows, with the figures of its row.
struct FittedModel {
  Model model;
  Fit fit;
  LedgerRow row;
};

// Whether a search of these data tries the term as it is.
bool is_usual(const Term& term, const Model& model, const Series& data);

// count: the last terms of `after`, which were added. `found`: what may be missing from `before`, these terms among it.
EffectTest effect_test_of(Inference& found, FittedModel before, FittedModel after, std::size_t count,
                          const Series& data, std::size_t target);

// Tests errors of the machine that are added to a model of recordings, by their joint fit with all others.
//
// As effect_test(), for a model and data with is_of_machine_errors(). An error is supported if it is significant among
// all errors of the axes, as in machine_errors(), and if its value from one direction predicts the other.
EffectTest machine_error_test(const Model& model, const std::vector<Term>& added, const Series& data,
                              std::size_t target);

std::vector<DropTest> machine_error_drop_tests(const Model& model, std::size_t count, const Series& data);

LedgerRow machine_error_row(const Model& model, const Series& data, std::size_t target);

}  // namespace ballbar

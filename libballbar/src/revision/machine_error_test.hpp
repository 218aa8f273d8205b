// Errors of the machine added to a model of recordings: what their fit beside all others says of them.
#pragma once

#include "ballbar/revision/effect_test.hpp"

namespace ballbar {

// As effect_test(), of a model and data of which is_of_machine_errors() holds. An error is supported where it is
// significant among all errors of the axes, as in machine_errors(), and its value from one direction predicts the
// other.
EffectTest machine_error_test(const Model& model, const std::vector<Term>& added, const Series& data,
                              std::size_t target);

std::vector<DropTest> machine_error_drop_tests(const Model& model, std::size_t count, const Series& data);

LedgerRow machine_error_row(const Model& model, const Series& data, std::size_t target);

}  // namespace ballbar

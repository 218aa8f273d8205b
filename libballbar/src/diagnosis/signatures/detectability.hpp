// What each effect of a signature library could show.
#pragma once

#include <optional>
#include <vector>

#include "ballbar/diagnosis/signatures/identifiability.hpp"
#include "diagnosis/signatures/signature_library.hpp"

namespace ballbar {

// One an effect of the catalogue at the model's level, but for the base that every model has, in its order.
std::vector<Detectability> detectability_of(const Catalogue& catalogue, const SignatureLibrary& library,
                                            const Projected& projection, const Model& model, const Series& data,
                                            std::optional<Motion> motion);

}  // namespace ballbar

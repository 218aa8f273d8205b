// What each effect of a bank could show.
#pragma once

#include <optional>
#include <vector>

#include "ballbar/diagnosis/signatures/identifiability.hpp"
#include "diagnosis/signatures/bank.hpp"

namespace ballbar {

// One an effect of the catalogue at the model's level (the circle is the base of every recording), in its order.
std::vector<Prospect> prospects_of(const Bank& bank, const Projected& seen, const Model& model, const Series& data,
                                   std::optional<Motion> motion);

}  // namespace ballbar

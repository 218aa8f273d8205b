#pragma once

#include <nlohmann/json_fwd.hpp>

#include "ballbar/drift/comparison.hpp"

namespace ballbar {

// The keys of `compare --json`.
nlohmann::ordered_json json_of(const Comparison& comparison);

}  // namespace ballbar

#pragma once

#include <nlohmann/json.hpp>

namespace ballbar {

// null where it is not finite, which JSON has no number for.
nlohmann::ordered_json number(double value);

}  // namespace ballbar

#include "terminal/json_number.hpp"

#include <cmath>

namespace ballbar {

nlohmann::ordered_json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value;
}

}  // namespace ballbar

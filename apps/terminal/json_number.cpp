#include "terminal/json_number.hpp"

#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

nlohmann::ordered_json number(double value) { return json_value(value); }

}  // namespace ballbar

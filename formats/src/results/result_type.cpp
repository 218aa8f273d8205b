#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {
namespace {

double rounded(double value) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  const double scale = std::pow(10.0, 6.0 - std::floor(std::log10(std::abs(value))));
  // Beyond these the scale leaves the range of a double, or rounding shows in the last digits.
  return std::isfinite(scale) && scale > 0.0 ? std::round(value * scale) / scale : value;
}

}  // namespace

nlohmann::ordered_json json_value(const Bulk& bulk) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  json.get_ref<nlohmann::ordered_json::array_t&>().reserve(bulk.values.size());
  for (const double value : bulk.values) json.push_back(json_value(rounded(value)));
  return json;
}

}  // namespace ballbar

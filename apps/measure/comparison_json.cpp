#include "measure/comparison_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "terminal/json_number.hpp"

namespace ballbar {
namespace {

constexpr const char* kNames[] = {"offset", "gain", "lag", "drift"};

nlohmann::ordered_json json_of(const DifferenceParts& parts, const std::string& unit) {
  const std::string units[] = {"_" + unit, "", "_s", fmt::format("_{}_per_h", unit)};
  nlohmann::ordered_json json;
  for (std::size_t kind = 0; kind < kDifferenceKinds.size(); ++kind) {
    const std::optional<DifferencePart>& part = parts[kind];
    if (!part) {
      json[kNames[kind]] = nullptr;
      continue;
    }
    json[kNames[kind]] = {{"value" + units[kind], number(part->value)},
                          {"sigma" + units[kind], number(part->sigma)},
                          {"chance", number(part->chance)},
                          {"named", part->named}};
  }
  return json;
}

nlohmann::ordered_json json_of(const DifferenceStructure& structure, const std::string& unit) {
  nlohmann::ordered_json json;
  json["stands_out"] = structure.stands_out;
  json["parts"] = json_of(structure.parts, unit);
  json["alone"] = json_of(structure.alone, unit);
  json["sufficient_alone"] = nlohmann::ordered_json::array();
  for (const DifferenceKind kind : sufficient_alone(structure)) {
    json["sufficient_alone"].push_back(kNames[static_cast<std::size_t>(kind)]);
  }
  json["limit_of_part"] = number(structure.limit_of_part);
  json["together"] = {{"chi2", number(structure.chi2_of_parts)},
                      {"freedom", structure.parts_freedom},
                      {"chance", number(structure.chance_of_parts)},
                      {"limit", number(structure.limit_of_parts)}};
  json["whole"] = {{"chi2", number(structure.chi2)}, {"freedom", structure.rows}};
  json["noise"] = structure.noise == NoiseOfDifference::stated    ? "stated"
                  : structure.noise == NoiseOfDifference::widened ? "widened"
                                                                  : "from rows";
  if (structure.noise == NoiseOfDifference::widened) json["widened_by"] = number(structure.widened_by);
  if (structure.noise == NoiseOfDifference::from_rows) json["noise_" + unit] = number(structure.widened_by);
  return json;
}

nlohmann::ordered_json json_of(const AxisComparison& axis) {
  nlohmann::ordered_json json;
  const auto put = [&](const std::string& key, const std::optional<double>& value) {
    json[key] = value ? number(*value) : nlohmann::ordered_json(nullptr);
  };
  const auto with_unit = [&](const char* name) { return fmt::format("{}_{}", name, axis.unit); };
  json["agreement"] = axis.agreement == Agreement::agrees      ? "agrees"
                      : axis.agreement == Agreement::disagrees ? "disagrees"
                                                               : "cannot tell";
  put("mean_relative_deviation", axis.mean_relative_deviation);
  put("expected_relative_deviation", axis.expected_relative_deviation);
  put("explained_share", axis.explained_share);
  put("range_normalised_mean_deviation", axis.range_deviation);
  put(with_unit("rmse"), axis.rmse);
  put(with_unit("max"), axis.largest);
  put("max_at_s", axis.largest_s);
  put(with_unit("bias"), axis.bias);
  put(with_unit("loa_low"), axis.limit_low);
  put(with_unit("loa_high"), axis.limit_high);
  json["within_2_sigma"] = axis.within;
  json["samples"] = axis.counted;
  put("correlation", axis.correlation);
  put("lag_s", axis.lag_s);
  put("lag_sigma_s", axis.lag_sigma_s);
  if (axis.deviation) {
    json["deviation"] = {{"from_s", axis.deviation->from_s},
                         {"to_s", axis.deviation->to_s},
                         {"to_the_end", axis.deviation->to_the_end},
                         {with_unit("largest"), axis.deviation->largest},
                         {with_unit("sigma"), number(axis.deviation->sigma)},
                         {"at_s", axis.deviation->at_s}};
  }
  json["structure"] = axis.structure ? json_of(*axis.structure, axis.unit) : nlohmann::ordered_json(nullptr);
  json["budget"] = nlohmann::ordered_json::array();
  for (const UncertaintyShare& share : axis.budget) {
    json["budget"].push_back(
        {{"source", share.source}, {with_unit("sigma"), number(share.sigma)}, {"share", share.variance}});
  }
  json["points"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < axis.time_s.size(); ++i) {
    json["points"].push_back({{"time_s", axis.time_s[i]},
                              {with_unit("a"), axis.a[i]},
                              {with_unit("b"), axis.b[i]},
                              {with_unit("difference"), axis.difference[i]},
                              {with_unit("sigma"), number(axis.sigma[i])}});
  }
  return json;
}

}  // namespace

nlohmann::ordered_json json_of(const Comparison& comparison) {
  nlohmann::ordered_json json;
  json["conclusion"] = conclusion(comparison);
  json["a"] = comparison.a;
  json["b"] = comparison.b;
  json["reference_s"] = comparison.reference_s;
  json["samples"] = comparison.samples;
  json["left_out"] = comparison.left_out;
  for (const AxisComparison& axis : comparison.axes) json["axes"][axis.name] = json_of(axis);
  json["remarks"] = comparison.remarks;
  return json;
}

}  // namespace ballbar

#include "model/targets_in_um.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/column_named.hpp"
#include "ballbar/formats/logs/column_unit.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/model/model.hpp"

namespace ballbar {
namespace {

// Those that open_model takes, which says what is wrong with them.
std::vector<std::string> stated_targets(const ModelOptions& options, const ModelData& data) {
  try {
    if (!options.target.empty()) return columns_named(*data.series, options.target);
    if (options.model.empty()) return data.targets;
    const Model model = read_model(options.model.bytes(kLargestText), options.model.name(), options.catalogue);
    return columns_named(*data.series, model.targets);
  } catch (const Error&) {
    return {};
  }
}

std::string sigma_of(const std::string& target) {
  const std::string unit(unit_of(target));
  return unit.empty() ? "" : fmt::format("{}_sigma_{}", target.substr(0, target.size() - unit.size() - 1), unit);
}

}  // namespace

ModelData with_targets_in_um(ModelData data, const ModelOptions& options) {
  if (data.level != Level::series) return data;
  std::shared_ptr<Series> converted;
  for (const std::string& target : stated_targets(options, data)) {
    if (find_column(*data.series, target) == nullptr || !in_um(target)) continue;
    if (!converted) converted = std::make_shared<Series>(*data.series);
    for (Column& column : converted->columns) {
      if (column.name != target && column.name != sigma_of(target)) continue;
      const auto [name, unit] = *in_um(column.name);
      if (find_column(*converted, name) != nullptr) {
        throw Error(fmt::format("{}: expected {} in one unit, found {} too.", data.title, column.name, name));
      }
      for (double& value : column.values) value = unit.factor * value;
      if (column.header.empty()) column.header = column.name;
      if (column.name == target) {
        std::replace(data.targets.begin(), data.targets.end(), target, name);
        column.role = Role::measured;
        data.remarks.push_back(fmt::format("{}: read as {}, in um.", column.name, name));
      }
      column.name = name;
    }
  }
  if (converted) data.series = std::move(converted);
  return data;
}

}  // namespace ballbar

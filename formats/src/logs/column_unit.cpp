#include "ballbar/formats/logs/column_unit.hpp"

#include "logs/log_units.hpp"

namespace ballbar {
namespace {

std::optional<RenamedColumn> renamed(std::string_view stem, std::string_view unit) {
  const auto known = column_unit(unit);
  if (!known || stem.empty()) return std::nullopt;
  return RenamedColumn{std::string(stem) + "_" + known->canonical, *known};
}

}  // namespace

std::optional<ColumnUnit> column_unit(std::string_view unit) {
  const auto known = scaled_unit(unit);
  if (!known) return std::nullopt;
  return ColumnUnit{std::string(known->canonical), known->factor, known->offset};
}

std::optional<RenamedColumn> in_unit_of_series(std::string_view name) {
  if (!unit_of(name).empty()) return std::nullopt;
  const NameAndUnit split = name_and_unit(name);
  return renamed(split.name, split.unit);
}

std::optional<RenamedColumn> in_um(std::string_view name) {
  const std::string_view unit = unit_of(name);
  if (unit == "um") return std::nullopt;
  const NameAndUnit split =
      unit.empty() ? name_and_unit(name)
                   : NameAndUnit{std::string(name.substr(0, name.size() - unit.size() - 1)), std::string(unit)};
  auto found = renamed(split.name, split.unit);
  return found && found->unit.canonical == "um" ? found : std::nullopt;
}

}  // namespace ballbar

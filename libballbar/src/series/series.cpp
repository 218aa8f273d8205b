#include "ballbar/series/series.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ballbar {
namespace {

constexpr std::string_view kUnits[] = {"um",      "mm", "urad", "degC",      "rpm",        "A",           "W", "K",
                                       "percent", "Nm", "bar",  "l_per_min", "mm_per_min", "deg_per_min", "V"};

constexpr std::array<std::pair<Role, std::string_view>, 10> kRoles = {{
    {Role::structure, "structure"},
    {Role::ambient, "ambient"},
    {Role::coolant, "coolant"},
    {Role::bearing, "bearing"},
    {Role::mean_point, "mean_point"},
    {Role::housing, "housing"},
    {Role::speed, "speed"},
    {Role::load, "load"},
    {Role::event, "event"},
    {Role::measured, "measured"},
}};

}  // namespace

std::string_view unit_of(std::string_view column_name) {
  const auto* unit = std::find_if(std::begin(kUnits), std::end(kUnits), [&](std::string_view one) {
    return column_name.size() > one.size() + 1 && column_name.ends_with(one) &&
           column_name[column_name.size() - one.size() - 1] == '_';
  });
  return unit == std::end(kUnits) ? std::string_view{} : *unit;
}

Role role_from_unit(std::string_view unit) {
  if (unit == "rpm") return Role::speed;
  if (unit == "degC") return Role::structure;
  if (unit == "um" || unit == "mm" || unit == "urad") return Role::measured;
  if (unit == "A" || unit == "W" || unit == "Nm" || unit == "percent") return Role::load;
  return Role::event;
}

std::string_view name_of(Role role) {
  const auto* entry = std::find_if(kRoles.begin(), kRoles.end(), [&](const auto& pair) { return pair.first == role; });
  return entry->second;
}

std::optional<Role> role_from_name(std::string_view name) {
  for (const auto& [role, role_name] : kRoles) {
    if (role_name == name) return role;
  }
  return std::nullopt;
}

const Column* find_column(const Series& series, std::string_view name) {
  const auto column =
      std::find_if(series.columns.begin(), series.columns.end(), [&](const Column& c) { return c.name == name; });
  return column == series.columns.end() ? nullptr : &*column;
}

std::vector<std::string> column_names(const Series& series) {
  std::vector<std::string> names;
  names.reserve(series.columns.size());
  for (const Column& column : series.columns) names.push_back(column.name);
  return names;
}

bool is_target(const Column& column) {
  return column.role == Role::measured && column.name.find("_sigma_") == std::string::npos;
}

std::string free_name(std::string_view name, std::set<std::string>& taken) {
  const std::string_view unit = unit_of(name);
  const std::string end = unit.empty() ? "" : "_" + std::string(unit);
  const std::string stem(name.substr(0, name.size() - end.size()));
  std::string full(name);
  for (int k = 2; full == "time_s" || full == "time_min" || !taken.insert(full).second; ++k)
    full = stem + "_" + std::to_string(k) + end;
  return full;
}

}  // namespace ballbar

#include "logs/log_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "logs/log_join.hpp"
#include "logs/log_roles.hpp"
#include "logs/log_table.hpp"
#include "logs/log_units.hpp"

namespace ballbar {
namespace {

constexpr double kFreezing_K = 273.15;

constexpr double kMostDrift_mm = 1.0, kFar_mm = 20.0;

// Whether lengths without a unit are plainly mm: they drift by 0.01 to 1 and are written to 0.0001, or to 0.001 far
// from zero. In um so little is noise, which does not move slowly.
bool drifts_in_mm(std::span<const double> values) {
  constexpr double kLeast_mm = 0.01;
  const Extremes range = extremes_of(values);
  const double travel = range.most - range.least;
  if (!(travel >= kLeast_mm && travel <= kMostDrift_mm)) return false;
  const auto is_written_to = [&](double least) {
    return std::all_of(values.begin(), values.end(), [&](double value) {
      return !std::isfinite(value) || std::abs(value / least - std::round(value / least)) < 1e-3;
    });
  };
  double steps = 0.0, before = NAN;
  std::size_t rows = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    if (rows++ > 0) steps += (value - before) * (value - before);
    before = value;
  }
  const double step = std::sqrt(steps / static_cast<double>(rows));
  const bool is_far = std::min(std::abs(range.least), std::abs(range.most)) > kFar_mm;
  return rows > 3 && step < 0.25 * travel && is_written_to(1e-6) && (is_far || !is_written_to(1e-3));
}

// A name that can be typed: letters, digits and _; then the unit.
std::string column_name(std::string_view name, std::string_view unit, std::set<std::string>& taken) {
  std::string stem;
  for (const char c : name) {
    const bool kept = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || (c & 0x80) != 0;
    if (kept)
      stem += c;
    else if (!stem.empty() && stem.back() != '_')
      stem += '_';
  }
  for (const std::string_view sign : {"°", "º", "\u00A0", "（", "）", "Â"}) {
    for (std::size_t at = stem.find(sign); at != std::string::npos; at = stem.find(sign)) stem.erase(at, sign.size());
  }
  while (stem.ends_with('_')) stem.pop_back();
  if (stem.empty()) stem = "column";
  return free_name(unit.empty() ? stem : fmt::format("{}_{}", stem, unit), taken);
}

}  // namespace

std::string take_mm(LogPlan& plan, const std::vector<std::vector<double>>& values) {
  std::vector<PlannedColumn*> lengths;
  bool are_mm = false;
  Extremes range{HUGE_VAL, -HUGE_VAL};
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    PlannedColumn& column = plan.columns[i];
    if (column.kind != ColumnKind::number || is_time(plan, i) || !column.unit.empty() || column.stated.role ||
        (!column.stated.unit.empty() && !column.unit_by_pattern) ||
        found_role(column.name, "", values[i]).role != Role::measured)
      continue;
    const Extremes of_column = extremes_of(values[i]);
    if (names_an_axis(column.name) && std::max(-of_column.least, of_column.most) > kFar_mm) continue;
    if (of_column.most - of_column.least > kMostDrift_mm) return {};
    are_mm = are_mm || drifts_in_mm(values[i]);
    range = {std::min(range.least, of_column.least), std::max(range.most, of_column.most)};
    lengths.push_back(&column);
  }
  if (!are_mm) return {};
  std::vector<std::string_view> names;
  for (PlannedColumn* column : lengths) {
    column->unit = "mm";
    names.emplace_back(column->source);
  }
  return fmt::format("{}: no unit, and values from {:g} to {:g}: read as mm. State --unit '{}=um' if they are in um.",
                     fmt::join(names, ", "), range.least, range.most, names.front());
}

void take_column(const PlannedColumn& planned, std::vector<double>&& values, const std::string& why,
                 const std::string& name, Log& log, std::set<std::string>& taken) {
  const ColumnRecipe& stated = planned.stated;
  LogColumn column;
  column.source = planned.source;
  column.found_unit = planned.unit;
  if (std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v); })) {
    column.gaps = values.size();
    column.why = "has no value";
    log.columns.push_back(std::move(column));
    return;
  }
  // "Valve_A" and "Door_C" are names, where they are 0 and 1.
  const bool letter_is_name = planned.unit.size() == 1 && stated.unit.empty() && is_switch(values) &&
                              planned.source.size() > 1 && planned.source.ends_with(planned.unit) &&
                              planned.source[planned.source.size() - 2] == '_';
  if (letter_is_name) column.found_unit.clear();
  const std::string& stem = letter_is_name ? planned.source : planned.name;
  const bool pattern_gives_way =
      planned.unit_by_pattern && (!why.empty() || !found_role(planned.name, "", values).unit.empty());
  const auto unit = letter_is_name ? std::nullopt
                    : stated.unit.empty() || pattern_gives_way
                        ? scaled_unit(planned.unit)
                        : stated_unit(stated.unit, fmt::format("{}: {}", name, planned.source));
  double factor = 1.0, offset = 0.0;
  if (unit) {
    column.unit = unit->canonical;
    factor = unit->factor;
    offset = unit->offset;
    if (column.unit == "K" && factor == 1.0) {
      const Extremes range = extremes_of(values);
      if (range.least > 150.0) {
        column.unit = "degC";
        offset = -kFreezing_K;
      }
    }
  }
  if (factor != 1.0 || offset != 0.0) {
    for (double& value : values) value = value * factor + offset;
  }
  const FoundRole found = found_role(stem, column.unit, values);
  // Whose unit of length a user states is no axis, however far it moves.
  const bool is_length = !stated.unit.empty() && !planned.unit_by_pattern && column.unit == "um";
  column.role = stated.role.value_or(is_length ? Role::measured : found.role);
  column.role_is_stated = stated.role.has_value();
  column.why = stated.role                                     ? "by the recipe"
               : !why.empty() && found.role == Role::structure ? why
               : is_length                                     ? "by its unit"
                                                               : found.why;
  if (column.unit.empty() && column.found_unit.empty() && (stated.unit.empty() || pattern_gives_way))
    column.unit = found.unit;
  if (!stated.name.empty()) {
    column.name = column_name(stated.name.ends_with("_" + column.unit) && !column.unit.empty()
                                  ? std::string_view(stated.name).substr(0, stated.name.size() - column.unit.size() - 1)
                                  : std::string_view(stated.name),
                              column.unit, taken);
  } else {
    column.name = column_name(stem, column.unit, taken);
  }
  log.series.columns.push_back({column.name, column.role, std::move(values), column.source});
  log.columns.push_back(std::move(column));
}

Series with_stated_columns(Series series, const LogRecipe& recipe, const std::string& name) {
  const auto refuse = [&](bool is_given, std::string_view option) {
    if (is_given) throw Error(fmt::format("{}: expected a log for {}, found a ballbar series.", name, option));
  };
  refuse(!recipe.join.empty(), "--join");
  refuse(recipe.burst_means, "--burst-means");
  refuse(!recipe.time.empty(), "--time");
  refuse(recipe.every_s && series.has_clock, "--every");
  if (recipe.every_s) {
    for (double& time : series.time_s) time *= *recipe.every_s;
    series.has_clock = true;
  }
  shift_clock(series, recipe, name);
  if (recipe.columns.empty()) return series;
  Headers headers;
  for (const Column& column : series.columns) {
    const std::size_t unit = unit_of(column.name).size();
    headers.emplace_back(column.name, column.name.substr(0, column.name.size() - (unit == 0 ? 0 : unit + 1)));
  }
  expect_recipe_columns(headers, name, 1, recipe);
  std::vector<std::string> units;
  for (const Column& column : series.columns) units.emplace_back(unit_of(column.name));
  const std::vector<StatedColumn> all = stated_columns(recipe, headers, units);
  std::vector<Column> columns;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    const auto& [source, stem] = headers[i];
    Column& column = series.columns[i];
    std::string unit = units[i];
    const ColumnRecipe& stated = all[i].column;
    if (stated.left_out) continue;
    if (!stated.unit.empty() && !unit.empty() && stated.unit != unit) {
      throw Error(fmt::format("{}: {}: expected no other unit than {}, which its name states, found {}.", name, source,
                              unit, in_quotes(stated.unit)));
    }
    if (!stated.unit.empty() && unit.empty()) {
      const LogUnit found = stated_unit(stated.unit, fmt::format("{}: {}", name, source));
      for (double& value : column.values) value = value * found.factor + found.offset;
      unit = found.canonical;
      if (column.role == Role::event) column.role = role_from_unit(unit);
    }
    if (stated.role) column.role = *stated.role;
    column.header = source;
    column.name = column_name(stated.name.empty() ? stem : stated.name, unit, taken);
    columns.push_back(std::move(column));
  }
  if (columns.empty()) throw Error(fmt::format("{}: expected a column that is not left out, found none.", name));
  series.columns = std::move(columns);
  return series;
}

}  // namespace ballbar

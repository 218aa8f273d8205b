#include "logs/log_temperatures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "logs/log_roles.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"

namespace ballbar {
namespace {

constexpr double kColdest_degC = 5.0, kWarmest_degC = 90.0;
constexpr double kWarmestHeater_degC = 350.0;  // of a name of a temperature that begins cold
constexpr double kUsualStep_K = 0.5;           // from row to row: of the noise and the rounding of a sensor
constexpr double kSlowShareOfWord = 0.5;       // where the name says temperature: rows read by hand are few
constexpr double kSlowShare = 0.25;            // of the variance: a smaller mean square step is no noise (von Neumann)
constexpr double kApart_K = 12.0;              // of a family without a name of temperature, in its first rows
constexpr double kBeside_K = 6.0;              // from the temperatures beside it
constexpr std::size_t kFamily = 3;

// Within the range, but for one value in a hundred.
bool lies_within(std::span<const double> values, double warmest_degC) {
  std::size_t inside = 0, all = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    ++all;
    inside += value >= kColdest_degC && value <= warmest_degC;
  }
  return all >= 2 && (all - inside) * 100 <= all;
}

// From row to row it changes by less than a sensor's noise, or by little of how far it moves.
bool moves_slowly(std::span<const double> values, double warmest_degC, double slow_share) {
  double sum = 0.0, squares = 0.0, steps = 0.0, last = 0.0;
  std::size_t count = 0;
  for (const double value : values) {
    if (!(value >= kColdest_degC && value <= warmest_degC)) continue;  // gaps, and what lies_within forgives
    if (count > 0) steps += (value - last) * (value - last);
    sum += value;
    squares += value * value;
    last = value;
    ++count;
  }
  if (count < 3) return false;
  const auto n = static_cast<double>(count);
  const double variance = std::max(0.0, squares / n - (sum / n) * (sum / n));
  const double step = steps / (n - 1.0);
  return step <= kUsualStep_K * kUsualStep_K || step <= slow_share * variance;
}

// A count, a state or a number of a tool.
bool is_whole(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isnan(value) || value == std::floor(value); });
}

bool is_degrees(std::string_view unit) {
  const auto known = log_unit(unit);
  return known && known->canonical == "degC" && known->factor == 1.0;
}

// A family of one letter that stands for forces, distances, axes, currents ...: "F#", "d1".
bool is_letter_of_another(std::string_view stem) {
  return stem.size() == 2 && std::string_view("fdxyzuvwaipqnlegho").find(stem[0]) != std::string_view::npos;
}

// As the recipe says.
bool is_no_temperature(const ColumnRecipe& stated) {
  return stated.role == Role::measured || stated.role == Role::event || stated.role == Role::speed ||
         stated.role == Role::load;
}

// The name with # in place of each number.
std::string family_of(std::string_view name) {
  std::string stem;
  for (const char c : folded(name)) {
    if (!is_digit(c))
      stem += c;
    else if (!stem.ends_with('#'))
      stem += '#';
  }
  return stem;
}

double first_of(std::span<const double> values) {
  const auto first = std::find_if(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  return first == values.end() ? NAN : *first;
}

// Of columns that no name tells: those that begin near the middle one. In a log without any name all but the last may
// begin further off: machines begin warm, and the last column is often what was measured.
void keep_alike(std::vector<std::size_t>& columns, const std::vector<std::vector<double>>& values, bool nameless) {
  std::vector<double> firsts;
  firsts.reserve(columns.size());
  for (const std::size_t column : columns) firsts.push_back(first_of(values[column]));
  if (firsts.empty()) return;
  const double middle = median(firsts);
  std::erase_if(columns, [&](std::size_t column) {
    return (!nameless || column + 1 == values.size()) && std::abs(first_of(values[column]) - middle) > kApart_K;
  });
}

std::string text_of(const LogPlan& plan, const std::vector<std::size_t>& columns, std::string_view by) {
  const std::string& first = plan.columns[columns.front()].source;
  const std::string& last = plan.columns[columns.back()].source;
  return fmt::format("{} {} {}: temperatures by {}, degC.", first, columns.size() == 2 ? "and" : "to", last, by);
}

// Of columns that are in no family.
TemperatureFamily together(const LogPlan& plan, std::vector<std::size_t> columns, std::string_view by) {
  std::sort(columns.begin(), columns.end());
  std::vector<std::string_view> names;
  names.reserve(columns.size());
  for (const std::size_t column : columns) names.emplace_back(plan.columns[column].source);
  std::string text = fmt::format("{}: {} by {}, degC.", fmt::join(names, ", "),
                                 names.size() == 1 ? "a temperature" : "temperatures", by);
  return {std::move(columns), std::move(text)};
}

// Columns that no name tells, beside at least three temperatures whose first values are near theirs.
std::vector<std::size_t> beside(const LogPlan& plan, const std::vector<std::vector<double>>& values,
                                const std::vector<std::size_t>& candidates, const std::vector<std::size_t>& known) {
  if (known.size() < kFamily) return {};
  double low = kWarmest_degC, high = kColdest_degC;
  for (const std::size_t column : known) {
    low = std::min(low, first_of(values[column]));
    high = std::max(high, first_of(values[column]));
  }
  std::vector<std::size_t> found;
  for (const std::size_t column : candidates) {
    const double first = first_of(values[column]);
    if (first < low - kBeside_K || first > high + kBeside_K || !lies_within(values[column], kWarmest_degC) ||
        !moves_slowly(values[column], kWarmest_degC, kSlowShare) || has_few_levels(values[column]) ||
        is_whole(values[column]) || names_another_quantity(plan.columns[column].name) ||
        could_be_measured(plan.columns[column].name))
      continue;
    found.push_back(column);
  }
  return found;
}

}  // namespace

// To degC, of a column that is a temperature by its unit, or by its name where it has none. Not of one that is
// measured.
std::optional<LogUnit> temperature_unit(const PlannedColumn& column) {
  if (column.stated.role == Role::measured || column.stated.role == Role::event) return std::nullopt;
  const std::string& unit = column.stated.unit.empty() || column.unit_by_pattern ? column.unit : column.stated.unit;
  if (unit.empty()) {
    const bool named = says_temperature(column.name) || names_a_part(column.name);
    return named && !names_another_quantity(column.name) ? std::optional(LogUnit{"degC"}) : std::nullopt;
  }
  const auto known = log_unit(unit);
  return known && known->canonical == "degC" ? known : std::nullopt;
}

void take_fahrenheit(LogPlan& plan, const std::vector<std::vector<double>>& values) {
  const auto ends_in_f = [](const PlannedColumn& column) {
    const std::string_view name = column.name;
    return column.headed && column.kind == ColumnKind::number && column.unit.empty() && column.stated.unit.empty() &&
           name.size() > 2 && (name.ends_with(" F") || name.ends_with(" f"));
  };
  const auto take = [](PlannedColumn& column) {
    column.unit = "F";
    column.name.resize(column.name.size() - 2);
  };
  const auto is_degF = [](const PlannedColumn& column) {
    const auto unit = log_unit(column.unit);
    return unit && unit->canonical == "degC" && unit->factor != 1.0;
  };
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    PlannedColumn& column = plan.columns[i];
    if (ends_in_f(column) && names_the_room(column.name) && extremes_of(values[i]).least > kWarmestRoom_degC)
      take(column);
  }
  if (std::none_of(plan.columns.begin(), plan.columns.end(), is_degF)) return;
  for (PlannedColumn& column : plan.columns) {
    if (ends_in_f(column) && (says_temperature(column.name) || names_a_part(column.name))) take(column);
  }
}

std::string take_scale(LogPlan& plan, const std::vector<std::vector<double>>& values) {
  constexpr double kColdest_degF = 59.0, kWarmest_degF = 100.0, kAlike_degF = 2.0;
  constexpr double kColdest_K = 268.0, kWarmest_K = 340.0;
  std::vector<std::size_t> columns;
  std::vector<std::string_view> names;
  double low = HUGE_VAL, high = -HUGE_VAL;
  bool has_room = false;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    const PlannedColumn& column = plan.columns[i];
    if (is_degrees(column.unit)) return {};
    const double first = first_of(values[i]);
    if (column.kind != ColumnKind::number || is_time(plan, i) || !column.headed || !column.unit.empty() ||
        is_no_temperature(column.stated) || (!column.stated.unit.empty() && !column.unit_by_pattern) ||
        !(says_temperature(column.name) || names_a_part(column.name)) || names_another_quantity(column.name) ||
        has_few_levels(values[i]) || std::isnan(first))
      continue;
    columns.push_back(i);
    names.emplace_back(column.source);
    low = std::min(low, first);
    high = std::max(high, first);
    has_room = has_room || names_the_room(column.name);
  }
  if (columns.size() < (has_room ? 1 : 2)) return {};
  const bool are_K = low >= kColdest_K && high <= kWarmest_K;
  // Without a room a machine may be as warm in degC, but not all of it alike: that is a machine at rest.
  const bool are_degF = low > kWarmestRoom_degC && high <= kWarmest_degF &&
                        (has_room || (low >= kColdest_degF && high - low <= kAlike_degF));
  if (!are_K && !are_degF) return {};
  const std::string_view unit = are_K ? "K" : "degF";
  for (const std::size_t i : columns) plan.columns[i].unit = unit;
  return fmt::format("{} state no unit and begin at {:g} to {:g}: read as {}. State --unit '{}=degC' if they are not.",
                     fmt::join(names, ", "), low, high, unit, names.front());
}

std::vector<TemperatureFamily> temperatures_among(const LogPlan& plan, const std::vector<std::vector<double>>& values) {
  std::map<std::string, std::vector<std::size_t>> stems;
  const bool nameless =
      std::none_of(plan.columns.begin(), plan.columns.end(), [](const PlannedColumn& column) { return column.headed; });
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    const PlannedColumn& column = plan.columns[i];
    if (is_time(plan, i) || column.kind != ColumnKind::number || !column.unit.empty() ||
        is_no_temperature(column.stated) || (!column.stated.unit.empty() && !column.unit_by_pattern))
      continue;
    stems[family_of(column.headed ? column.name : "c1")].push_back(i);
  }
  std::vector<TemperatureFamily> families;
  std::vector<std::size_t> alone, others, known;
  for (auto& [stem, columns] : stems) {
    const PlannedColumn& first = plan.columns[columns.front()];
    const bool by_word = first.headed && says_temperature(first.name);
    const bool named = by_word || (first.headed && names_a_part(first.name));
    if (first.headed && names_another_quantity(first.name)) continue;
    if (!named && first.headed && is_letter_of_another(stem)) continue;
    const std::vector<std::size_t> all = columns;
    std::erase_if(columns, [&](std::size_t i) {
      const bool may_heat = by_word && extremes_of(values[i]).least < kWarmestRoom_degC;
      const double warmest_degC = may_heat ? kWarmestHeater_degC : kWarmest_degC;
      return !lies_within(values[i], warmest_degC) ||
             !moves_slowly(values[i], warmest_degC, by_word ? kSlowShareOfWord : kSlowShare) ||
             has_few_levels(values[i]) || (!by_word && is_whole(values[i])) ||
             (names_the_room(plan.columns[i].name) && first_of(values[i]) > kWarmestRoom_degC);
    });
    if (!named) keep_alike(columns, values, nameless);
    const std::size_t needed =
        named ? (all.size() + 1) / 2 : std::max(kFamily, first.headed ? (3 * all.size() + 3) / 4 : 0);
    if (columns.size() < needed || columns.empty()) {
      others.insert(others.end(), all.begin(), all.end());
      continue;
    }
    known.insert(known.end(), columns.begin(), columns.end());
    if (columns.size() == 1)
      alone.push_back(columns.front());
    else
      families.push_back({columns, text_of(plan, columns, named ? "name and values" : "values")});
  }
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    if (plan.columns[i].kind == ColumnKind::number && is_degrees(plan.columns[i].unit)) known.push_back(i);
  }
  if (!alone.empty()) families.push_back(together(plan, std::move(alone), "name and values"));
  if (auto columns = beside(plan, values, others, known); !columns.empty())
    families.push_back(together(plan, std::move(columns), "values like the columns beside it"));
  std::sort(families.begin(), families.end(),
            [](const auto& a, const auto& b) { return a.columns.front() < b.columns.front(); });
  return families;
}

}  // namespace ballbar

#include "logs/log_temperatures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "ballbar/numerics/order_statistic.hpp"
#include "logs/log_roles.hpp"
#include "logs/text_fold.hpp"

namespace ballbar {
namespace {

constexpr double kColdest_degC = 5.0, kWarmest_degC = 90.0;
constexpr double kUsualStep_K = 0.5;  // from row to row: of the noise and the rounding of a sensor
constexpr double kSlowShare = 0.25;   // of the variance: von Neumann's ratio of a signal that is no noise
constexpr double kApart_K = 12.0;     // of a family without a name of temperature, in its first rows
constexpr std::size_t kFamily = 3;

// Within the range, but for one value in a hundred.
bool lies_within(std::span<const double> values) {
  std::size_t inside = 0, all = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    ++all;
    inside += value >= kColdest_degC && value <= kWarmest_degC;
  }
  return all >= 2 && (all - inside) * 100 <= all;
}

// From row to row it changes by less than a sensor's noise, or by little of how far it moves.
bool moves_slowly(std::span<const double> values) {
  double sum = 0.0, squares = 0.0, steps = 0.0, last = 0.0;
  std::size_t count = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
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
  return step <= kUsualStep_K * kUsualStep_K || step <= kSlowShare * variance;
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

// Of columns that no name tells: those that begin near the middle one.
void keep_alike(std::vector<std::size_t>& columns, const std::vector<std::vector<double>>& values) {
  std::vector<double> firsts;
  firsts.reserve(columns.size());
  for (const std::size_t column : columns) firsts.push_back(first_of(values[column]));
  if (firsts.empty()) return;
  const double middle = median(firsts);
  std::erase_if(columns, [&](std::size_t column) { return std::abs(first_of(values[column]) - middle) > kApart_K; });
}

std::string text_of(const LogPlan& plan, const std::vector<std::size_t>& columns, std::string_view by) {
  const std::string& first = plan.columns[columns.front()].source;
  const std::string& last = plan.columns[columns.back()].source;
  if (columns.size() == 1) return fmt::format("{}: a temperature by {}, degC.", first, by);
  return fmt::format("{} {} {}: temperatures by {}, degC.", first, columns.size() == 2 ? "and" : "to", last, by);
}

}  // namespace

std::vector<TemperatureFamily> temperatures_among(const LogPlan& plan, const std::vector<std::vector<double>>& values) {
  std::map<std::string, std::vector<std::size_t>> stems;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    const PlannedColumn& column = plan.columns[i];
    const bool is_time = plan.time.kind == TimePlan::Kind::number && i == plan.time.column;
    if (is_time || column.kind != ColumnKind::number || !column.unit.empty() || column.stated.role == Role::measured)
      continue;
    stems[family_of(column.headed ? column.name : "c1")].push_back(i);
  }
  std::vector<TemperatureFamily> families;
  for (auto& [stem, columns] : stems) {
    const PlannedColumn& first = plan.columns[columns.front()];
    const bool named = first.headed && names_a_temperature(first.name);
    if (first.headed && names_another_quantity(first.name)) continue;
    const std::size_t members = columns.size();
    std::erase_if(columns, [&](std::size_t i) { return !lies_within(values[i]) || !moves_slowly(values[i]); });
    if (!named) keep_alike(columns, values);
    const std::size_t needed = named ? (members + 1) / 2 : std::max(kFamily, first.headed ? (3 * members + 3) / 4 : 0);
    if (columns.size() < needed || columns.empty()) continue;
    families.push_back({columns, text_of(plan, columns, named ? "name and values" : "values")});
  }
  std::sort(families.begin(), families.end(),
            [](const auto& a, const auto& b) { return a.columns.front() < b.columns.front(); });
  return families;
}

}  // namespace ballbar

#include "twins.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ballbar::verdicts {
namespace {

std::string renamed(const std::map<std::string, std::string>& names, const std::string& name) {
  const auto at = names.find(name);
  return at == names.end() ? name : at->second;
}

// Columns, targets and what the model reads.
void rename(Made& made, const std::map<std::string, std::string>& names) {
  for (Column& column : made.data.columns) column.name = renamed(names, column.name);
  for (std::string& target : made.model.targets) target = renamed(names, target);
  for (Term& term : made.model.terms) {
    for (std::string& column : term.columns) column = renamed(names, column);
  }
  for (Truth& truth : made.truths) {
    for (std::string& column : truth.columns) column = renamed(names, column);
  }
  for (std::string& driver : made.drivers) driver = renamed(names, driver);
}

std::map<std::string, std::string> turned(const std::map<std::string, std::string>& names) {
  std::map<std::string, std::string> result;
  for (const auto& [from, to] : names) result[to] = from;
  return result;
}

Series fewer_rows(const Series& data, Chance& chance) {
  Series result = data;
  result.time_s.clear();
  for (Column& column : result.columns) column.values.clear();
  for (std::size_t row = 0; row < data.time_s.size(); ++row) {
    if (chance.happens(0.3)) continue;
    result.time_s.push_back(data.time_s[row]);
    for (std::size_t k = 0; k < data.columns.size(); ++k) {
      result.columns[k].values.push_back(data.columns[k].values[row]);
    }
  }
  return result;
}

// Of four rows.
Series means(const Series& data) {
  constexpr std::size_t kRows = 4;
  const auto mean_of = [](const std::vector<double>& values) {
    std::vector<double> result;
    result.reserve(values.size() / kRows);
    for (std::size_t row = 0; row + kRows <= values.size(); row += kRows) {
      double sum = 0.0;
      for (std::size_t k = 0; k < kRows; ++k) sum += values[row + k];
      result.push_back(sum / static_cast<double>(kRows));
    }
    return result;
  };
  Series result = data;
  result.time_s = mean_of(data.time_s);
  for (Column& column : result.columns) column.values = mean_of(column.values);
  return result;
}

// Another reading of the same machine, named so that effects of an axial drift could read it: half of what the target
// shows, more of a temperature, noise of its own.
Column another_target(const Made& made, Chance& chance) {
  const std::vector<double>& target = find_column(made.data, made.model.targets.front())->values;
  std::vector<double> values = drawn({1.5 * made.sigma_um, 1500.0, 0.1 * made.sigma_um}, made.data.time_s, chance);
  for (std::size_t row = 0; row < values.size(); ++row) values[row] += 0.5 * target[row];
  for (const Column& column : made.data.columns) {
    if (unit_of(column.name) != "degC") continue;
    for (std::size_t row = 0; row < values.size(); ++row) {
      values[row] += 2.0 * made.sigma_um * (column.values[row] - column.values[0]);
    }
    break;
  }
  for (double& value : values) value = rounded(value, 0.01);
  return {"axial_um", Role::measured, std::move(values)};
}

std::vector<std::string> labels(const std::vector<Member>& members, const std::map<std::string, std::string>& names) {
  std::vector<std::string> result;
  for (const Member& member : members) {
    std::vector<std::string> columns;
    columns.reserve(member.columns.size());
    for (const std::string& column : member.columns) columns.push_back(renamed(names, column));
    result.push_back(fmt::format("{}({})", member.effect, fmt::join(columns, ", ")));
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

Twin twin_of(const Made& made, Change change, Chance& chance) {
  Twin twin{made, {}};
  Series& data = twin.made.data;
  std::map<std::string, std::string> names;
  switch (change) {
    case Change::fewer_rows:
      data = fewer_rows(made.data, chance);
      break;
    case Change::means:
      data = means(made.data);
      break;
    case Change::renamed:
      for (std::size_t k = 0; k < data.columns.size(); ++k) {
        const std::string& name = data.columns[k].name;
        names[name] = fmt::format("{}{}_{}", "qwertyuiop"[k % 10], 97 - 3 * k, unit_of(name));
      }
      break;
    case Change::kelvin:
      for (Column& column : data.columns) {
        if (unit_of(column.name) != "degC") continue;
        names[column.name] = column.name.substr(0, column.name.size() - 4) + "K";
        for (double& value : column.values) value += 273.15;
      }
      break;
    case Change::noise_column: {
      Column noise{"T_spare_degC", Role::structure, {}};
      noise.values.reserve(data.time_s.size());
      while (noise.values.size() < data.time_s.size()) {
        noise.values.push_back(rounded(22.0 + 0.1 * chance.normal(), 0.01));
      }
      data.columns.push_back(std::move(noise));
      break;
    }
    case Change::second_target:
      data.columns.push_back(another_target(made, chance));
      twin.made.model.targets.push_back(data.columns.back().name);
      break;
  }
  rename(twin.made, names);
  twin.before = turned(names);
  return twin;
}

bool is_same_verdict(const Said& before, const Said& after, const Twin& twin) {
  return before.word == after.word && labels(before.named, {}) == labels(after.named, twin.before);
}

}  // namespace ballbar::verdicts

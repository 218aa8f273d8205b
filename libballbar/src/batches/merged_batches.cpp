#include "ballbar/batches/merged_batches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/batches/batch.hpp"

namespace ballbar {
namespace {

constexpr double kBetween_s = 864000.0;  // 10 days
constexpr double kRow_s = 1.0;           // after and before which the machine stands

std::vector<std::string> columns_of(const Model& model) {
  std::vector<std::string> names = model.targets;
  for (const Term& term : model.terms) names.insert(names.end(), term.columns.begin(), term.columns.end());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace

Series joined_batches(std::span<const Series> batches, const Model& model) {
  Series all;
  for (const std::string& name : columns_of(model)) {
    const Column& first = column_of(batches.front(), name);
    all.columns.push_back({name, first.role, {}});
  }
  double begin_s = 0.0;
  const auto stand = [&](double time_s) {
    all.time_s.push_back(time_s);
    for (Column& column : all.columns) {
      column.values.push_back(column.role == Role::measured ? std::numeric_limits<double>::quiet_NaN() : 0.0);
    }
  };
  for (const Series& batch : batches) {
    if (!all.time_s.empty()) {
      stand(all.time_s.back() + kRow_s);
      begin_s = all.time_s.back() + kBetween_s;
      stand(begin_s - kRow_s);
    }
    for (const double time_s : batch.time_s) all.time_s.push_back(begin_s + time_s - batch.time_s.front());
    for (Column& column : all.columns) {
      const Column& own = column_of(batch, column.name);
      const double from = is_sensor(column) ? own.values.front() : 0.0;
      for (const double value : own.values) column.values.push_back(value - from);
    }
  }
  return all;
}

}  // namespace ballbar

#include "diagnosis/verdict/not_used.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "ballbar/internal/series/signal_kind.hpp"

namespace ballbar {

std::vector<ColumnNotSearched> columns_not_searched(const Problem& problem, const Model& model) {
  std::vector<ColumnNotSearched> found;
  for (const Column& column : problem.logged.series.columns) {
    if (column.role == Role::measured || column.name.find("_sigma_") != std::string::npos) continue;
    const auto is_it = [&](const std::string& name) { return name == column.name; };
    const auto reads = [&](const auto& one) { return std::any_of(one.columns.begin(), one.columns.end(), is_it); };
    if (!may_drive(column.values) || std::any_of(model.targets.begin(), model.targets.end(), is_it) ||
        std::any_of(model.not_inputs.begin(), model.not_inputs.end(), is_it) ||
        std::any_of(model.terms.begin(), model.terms.end(), reads) ||
        std::any_of(problem.library.families.begin(), problem.library.families.end(),
                    [&](const Family& one) { return reads(one.bound); }))
      continue;
    const bool has_gaps =
        std::any_of(column.values.begin(), column.values.end(), [](double value) { return !std::isfinite(value); });
    found.push_back({column.name, has_gaps, false});
  }
  for (const std::string& column : problem.logged.series.unread) found.push_back({column, false, true});
  return found;
}

std::vector<Saturated> saturated_sensors(const Problem& problem) {
  std::vector<Saturated> found;
  if (problem.rows_of_faults.empty()) return found;
  const auto rows = static_cast<double>(problem.logged.series.time_s.size());
  const auto add = [&](const std::string& column, std::size_t count, bool is_stuck) {
    if (count > 0) found.push_back({column, static_cast<double>(count) / rows, is_stuck});
  };
  for (const LoggedInput& input : problem.logged.inputs) add(input.column, input.at_end.size(), input.is_stuck);
  add(problem.base.target, clipped_readings(problem.base, problem.tuning).size(), false);
  add(problem.base.target, stuck_readings(problem.base, problem.tuning).size(), true);
  return found;
}

}  // namespace ballbar

#include "errors/machine_errors_result.hpp"

#include "ballbar/formats/recordings/stored_errors.hpp"

namespace ballbar {
namespace {

ErrorRow row_of(const ErrorsReport& report, const MachineError& error, const RankedError* ranked) {
  ErrorRow row{error, std::nullopt, stored_value_of(report, error), same_as_stored(report, error), {}, {}, {}};
  if (ranked == nullptr) return row;
  row.ranked = *ranked;
  row.stored_rank = stored_rank_of(report, *ranked);
  const std::string& effect = ranked->effect->name;
  if (report.b5r) row.stored_individual_circularity_um = stored_individual_circularity_um(*report.b5r, effect);
  const std::set<std::string>& in_the_model = report.options.in_the_model;
  if (!in_the_model.empty()) row.in_the_model.value = in_the_model.contains(effect);
  return row;
}

}  // namespace

std::vector<ErrorRow> error_rows(const ErrorsReport& report) {
  const MachineErrors& found = report.found;
  std::vector<ErrorRow> rows;
  std::vector<bool> listed(found.errors.size(), false);
  for (const RankedError& ranked : found.ranked) {
    for (const std::size_t row : ranked.rows) {
      rows.push_back(row_of(report, found.errors[row], &ranked));
      listed[row] = true;
    }
  }
  for (std::size_t row = 0; row < found.errors.size(); ++row) {
    if (!listed[row]) rows.push_back(row_of(report, found.errors[row], nullptr));
  }
  return rows;
}

std::vector<BoundEffect> significant_effects(const ErrorsReport& report) {
  std::vector<BoundEffect> effects;
  for (const RankedError& one : report.found.ranked) {
    if (one.significant) effects.push_back({one.effect, {}});
  }
  return effects;
}

std::variant<ErrorsOfOne, ErrorsReports> result_of(const ErrorsReports& reports) {
  if (reports.groups.size() == 1 && reports.results_alone.empty()) return ErrorsOfOne{reports};
  return reports;
}

}  // namespace ballbar

// Parts of a report that are columns over time.
#include "report/report_parts.hpp"

namespace ballbar {

Bulk sigmas_of(const DriftAxis& axis) {
  Bulk sigmas{std::vector<double>(axis.value.size())};
  for (std::size_t row = 0; row < sigmas.values.size(); ++row) sigmas.values[row] = sigma_of(axis, row);
  return sigmas;
}

SignalsPart signals_part(const std::string& source, const Series& series) {
  SignalsPart part{source, {series.time_s}, {}};
  for (const Column& column : series.columns)
    part.columns.push_back({column.name, column.role, std::string(unit_of(column.name)), {column.values}});
  return part;
}

}  // namespace ballbar

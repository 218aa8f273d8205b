#include "model/measured_input.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/series/series.hpp"
#include "numerics/interpolation.hpp"

namespace ballbar {
namespace {

bool has_lines(const Column& column) {
  const auto known = std::count_if(column.values.begin(), column.values.end(), [](double v) { return !std::isnan(v); });
  return column.role == Role::measured && known > 0 && static_cast<std::size_t>(known) < column.values.size();
}

// Of a run without any value gaps.
void add_lines(const std::vector<double>& time_s, const std::vector<double>& column, const RowRange& run,
               std::vector<double>& values) {
  std::vector<double> known_s, known;
  for (std::size_t row = run.begin; row < run.end; ++row) {
    if (std::isnan(column[row])) continue;
    known_s.push_back(time_s[row]);
    known.push_back(column[row]);
  }
  std::size_t next = 0;  // first known value after the row
  for (std::size_t row = run.begin; row < run.end; ++row) {
    while (next < known.size() && known_s[next] <= time_s[row]) ++next;
    if (known.empty()) {
      values.push_back(column[row]);
    } else if (next == 0 || next == known.size()) {
      values.push_back(next == 0 ? known.front() : known.back());
    } else {
      const double share = (time_s[row] - known_s[next - 1]) / (known_s[next] - known_s[next - 1]);
      values.push_back(value_at(known, {next - 1, share}));
    }
  }
}

}  // namespace

std::vector<double> input_values(const Series& data, const Column& column) {
  if (!has_lines(column)) return column.values;
  std::vector<double> values;
  values.reserve(column.values.size());
  for (const RowRange& run : runs_of(data.time_s)) add_lines(data.time_s, column.values, run, values);
  return values;
}

std::vector<std::string> measured_inputs_with_gaps(const Model& model, const Series& data) {
  std::vector<std::string> names;
  if (model.level == Level::recording) return names;
  for (const Term& term : model.terms) {
    for (const std::string& name : term.columns) {
      const Column* column = find_column(data, name);
      if (column == nullptr || !has_lines(*column)) continue;
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

}  // namespace ballbar

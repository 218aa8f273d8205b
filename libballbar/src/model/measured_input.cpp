#include "ballbar/model/measured_input.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/interpolation.hpp"

namespace ballbar {
namespace {

bool has_lines(const Column& column) {
  const auto known = std::count_if(column.values.begin(), column.values.end(), [](double v) { return !std::isnan(v); });
  return column.role == Role::measured && known > 0 && static_cast<std::size_t>(known) < column.values.size();
}

}  // namespace

std::vector<double> input_values(const Series& data, const Column& column) {
  if (!has_lines(column)) return column.values;
  std::vector<double> known_s, known;
  for (std::size_t row = 0; row < column.values.size(); ++row) {
    if (std::isnan(column.values[row])) continue;
    known_s.push_back(data.time_s[row]);
    known.push_back(column.values[row]);
  }
  std::vector<double> values;
  std::size_t next = 0;  // first known value after the row
  for (const double time_s : data.time_s) {
    while (next < known.size() && known_s[next] <= time_s) ++next;
    if (next == 0 || next == known.size()) {
      values.push_back(next == 0 ? known.front() : known.back());
    } else {
      const double share = (time_s - known_s[next - 1]) / (known_s[next] - known_s[next - 1]);
      values.push_back(value_at(known, {next - 1, share}));
    }
  }
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

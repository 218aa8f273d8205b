#include "bindings.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "ballbar/trace.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostBindings = 512;  // of one effect

bool is_axial(const Series& data, const std::string& name) {
  return name == "z_um" || name == "axial_um" || (data.five_probe && data.five_probe->columns[4] == name);
}

bool is_read(const Model& model, const std::string& name) {
  return std::any_of(model.terms.begin(), model.terms.end(), [&](const Term& term) {
    return std::find(term.columns.begin(), term.columns.end(), name) != term.columns.end();
  });
}

double mean_of(const Column& column) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const double value : column.values) {
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, count));
}

bool suits(const Effect& effect, const Input& input, const Column& column, const Model& model, const Series& data) {
  if (effect.level == Level::recording) return column.name == trace_column(input.role);
  const std::string_view unit = unit_of(column.name);
  if (std::find(input.units.begin(), input.units.end(), unit) == input.units.end()) return false;
  if (column.name.find("_sigma_") != std::string::npos) return false;
  if (std::find(model.targets.begin(), model.targets.end(), column.name) != model.targets.end()) return false;
  if (effect.name == "clock_offset" && !is_read(model, column.name)) return false;
  if (unit == "um") return is_axial(data, column.name);
  if (effect.name == "bar_temperature") return column.name.find("bar") != std::string::npos;
  const bool elsewhere = column.role == Role::ambient || column.role == Role::coolant;
  if (effect.name == "bearing_rings" || effect.name == "viscosity_feedback") return unit == "rpm" || !elsewhere;
  return true;
}

}  // namespace

std::vector<std::vector<std::string>> bindings_of(const Effect& effect, const Model& model, const Series& data) {
  const bool by_warmth = effect.name == "gradient_bending";
  std::map<std::string, double> mean;
  for (const Column& column : data.columns) {
    if (by_warmth) mean[column.name] = mean_of(column);
  }
  std::vector<std::vector<std::string>> bindings{{}};
  for (const Input& input : effect.inputs) {
    std::vector<std::vector<std::string>> more;
    for (const Column& column : data.columns) {
      if (!suits(effect, input, column, model, data)) continue;
      for (const std::vector<std::string>& binding : bindings) {
        if (std::find(binding.begin(), binding.end(), column.name) != binding.end()) continue;
        if (by_warmth && !binding.empty() && mean[binding.front()] < mean[column.name]) continue;
        if (more.size() == kMostBindings) break;
        more.push_back(binding);
        more.back().push_back(column.name);
      }
    }
    bindings = std::move(more);
  }
  return bindings;
}

bool has_term(const Model& model, const Effect& effect, const std::vector<std::string>& columns) {
  return std::any_of(model.terms.begin(), model.terms.end(),
                     [&](const Term& term) { return term.effect->name == effect.name && term.columns == columns; });
}

}  // namespace ballbar

#include "model/bindings.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "ballbar/circle/recording.hpp"

namespace ballbar {
namespace {

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_axial(const Series& data, const std::string& name) {
  return name == "z_um" || name == "axial_um" || (data.five_probe && data.five_probe->columns[4] == name);
}

bool is_read(const Model& model, const std::string& name) {
  return std::any_of(model.terms.begin(), model.terms.end(),
                     [&](const Term& term) { return is_in(term.columns, name); });
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
  const bool takes_any = input.units.empty();
  if (!takes_any && std::find(input.units.begin(), input.units.end(), unit) == input.units.end()) return false;
  if (column.name.find("_sigma_") != std::string::npos) return false;
  if (is_in(model.targets, column.name) || is_in(model.not_inputs, column.name)) return false;
  if (input.of_another_effect && !is_read(model, column.name)) return false;
  if (input.accepts) return input.accepts(column);
  return unit != "um" || is_axial(data, column.name);
}

using Take = std::function<bool(const std::vector<std::string>&)>;

// Binds the first `free` inputs in every way, the last of them slowest; false where `take` wants no more. With means,
// the column of the first input is no colder than the others.
bool visit(const std::vector<std::vector<const Column*>>& choices, const std::map<std::string, double>& means,
           std::size_t free, std::vector<std::string>& bound, const Take& take) {
  if (free == 0) return take(bound);
  const auto later = bound.begin() + static_cast<std::ptrdiff_t>(free);
  for (const Column* column : choices[free - 1]) {
    const std::string& name = column->name;
    if (std::find(later, bound.end(), name) != bound.end()) continue;
    const bool colder = free == 1 && !means.empty() && std::any_of(later, bound.end(), [&](const std::string& other) {
                          return means.at(name) < means.at(other);
                        });
    if (colder) continue;
    bound[free - 1] = name;
    if (!visit(choices, means, free - 1, bound, take)) return false;
  }
  return true;
}

void visit_bindings(const Effect& effect, const Model& model, const Series& data, const Take& take) {
  std::map<std::string, double> means;
  std::vector<std::vector<const Column*>> choices(effect.inputs.size());
  for (const Column& column : data.columns) {
    if (effect.rules.first_input_warmest) means[column.name] = mean_of(column);
    for (std::size_t k = 0; k < choices.size(); ++k) {
      if (suits(effect, effect.inputs[k], column, model, data)) choices[k].push_back(&column);
    }
  }
  std::vector<std::string> bound(effect.inputs.size());
  visit(choices, means, bound.size(), bound, take);
}

}  // namespace

std::vector<std::vector<std::string>> bindings_of(const Effect& effect, const Model& model, const Series& data) {
  std::vector<std::vector<std::string>> bindings;
  visit_bindings(effect, model, data, [&](const std::vector<std::string>& binding) {
    bindings.push_back(binding);
    return bindings.size() < kMostBindings;
  });
  return bindings;
}

std::size_t count_of_bindings(const Effect& effect, const Model& model, const Series& data) {
  std::size_t count = 0;
  visit_bindings(effect, model, data, [&](const std::vector<std::string>&) { return ++count > 0; });
  return count;
}

bool has_term(const Model& model, const Effect& effect, const std::vector<std::string>& columns) {
  return std::any_of(model.terms.begin(), model.terms.end(),
                     [&](const Term& term) { return term.effect->name == effect.name && term.columns == columns; });
}

}  // namespace ballbar

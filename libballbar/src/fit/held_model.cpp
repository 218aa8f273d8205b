#include "ballbar/internal/fit/held_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"

namespace ballbar {

std::vector<FittedParameter> held_parameters(const Model& model) {
  std::vector<FittedParameter> parameters(1);
  parameters[0].value = model.constant_um.value_or(0.0);
  for (const Term& term : model.terms) {
    for (const Setting& setting : term.settings) {
      FittedParameter parameter;
      parameter.value = setting.start;
      parameters.push_back(parameter);
    }
  }
  return parameters;
}

Model held_at(Model model, const std::vector<FittedParameter>& parameters) {
  model.constant_um = parameters.front().value;
  std::size_t parameter = 1;
  for (Term& term : model.terms) {
    for (Setting& setting : term.settings) {
      setting.start = parameters[parameter++].value;
      setting.held = true;
      setting.stated = true;
    }
  }
  return model;
}

std::vector<ColumnRange> ranges_of(const Model& model, const Series& data) {
  std::vector<ColumnRange> ranges;
  for (const Term& term : model.terms) {
    for (const std::string& name : term.columns) {
      const auto same = [&](const ColumnRange& range) { return range.column == name; };
      if (std::any_of(ranges.begin(), ranges.end(), same)) continue;
      ColumnRange range{name, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
      const Column* column = find_column(data, name);
      if (column == nullptr) {
        std::vector<std::string_view> known;
        for (const Column& other : data.columns) known.push_back(other.name);
        throw Error(fmt::format("expected the column {} in the data to fit it to, found none; the nearest is {}.", name,
                                nearest_name(name, known)));
      }
      for (const double value : column->values) {
        if (!std::isfinite(value)) continue;
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
      }
      if (range.low <= range.high) ranges.push_back(range);
    }
  }
  return ranges;
}

}  // namespace ballbar

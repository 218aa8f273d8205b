#include "measure/fit_result.hpp"

#include <fmt/format.h>

#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

// "run 0, CCW", or the analysis.
std::string place_of(const B5r& test, const std::string& parent) {
  for (const StoredRun& run : test.run_results) {
    if (run.parent == parent && run.direction) return fmt::format("{}, {}", parent, name_of(*run.direction));
  }
  return parent;
}

}  // namespace

MayLack<TableOf<double>> stored_results(const std::vector<Compared>& results) {
  TableOf<double> stored;
  for (const Compared& result : results) {
    if (result.stored) stored.emplace_back(result.key, *result.stored);
  }
  return {stored.empty() ? std::nullopt : std::optional(stored)};
}

std::string text_of(const ResultsAlone& alone) {
  Table table({fmt::format("stored in {}", alone.file), "value", "unit", "of"});
  for (const ValueAlone& one : values_alone(alone))
    table.add({one.name, fmt::format("{}", one.value), one.unit, one.of});
  return table.text(table_width(150)) + '\n' + wrapped(alone.file + ": no readings, so there is nothing to fit.");
}

std::vector<ValueAlone> values_alone(const ResultsAlone& alone) {
  std::vector<ValueAlone> values;
  for (const StoredFeature& feature : alone.b5r.stored) {
    if (!feature.valid) continue;
    values.push_back({place_of(alone.b5r, feature.parent), feature.name, feature.value,
                      std::string(unit_of_data_type(feature.data_type))});
  }
  return values;
}

}  // namespace ballbar

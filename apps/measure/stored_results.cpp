// What a `.b5r` without readings stores.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "measure/recording_fits.hpp"
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

std::string text_of(const ResultsAlone& alone) {
  Table table({fmt::format("stored in {}", alone.file), "value", "unit", "of"});
  for (const StoredFeature& feature : alone.b5r.stored) {
    if (!feature.valid) continue;
    table.add({feature.name, fmt::format("{}", feature.value), std::string(unit_of_data_type(feature.data_type)),
               place_of(alone.b5r, feature.parent)});
  }
  return table.text(table_width(150)) + '\n' + wrapped(alone.file + ": without readings there is nothing to fit.");
}

nlohmann::ordered_json json_of(const ResultsAlone& alone) {
  nlohmann::ordered_json json = {{"file", alone.file}, {"stored", nlohmann::ordered_json::array()}};
  for (const StoredFeature& feature : alone.b5r.stored) {
    if (!feature.valid) continue;
    json["stored"].push_back({{"of", place_of(alone.b5r, feature.parent)},
                              {"name", feature.name},
                              {"value", feature.value},
                              {"unit", unit_of_data_type(feature.data_type)}});
  }
  return json;
}

}  // namespace ballbar

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/history/history.hpp"
#include "errors/test_files.hpp"
#include "errors/test_results.hpp"
#include "history/history_page.hpp"
#include "history/history_result.hpp"
#include "history/history_text.hpp"
#include "history/machine_folder.hpp"
#include "python/arrays.hpp"
#include "python/classes.hpp"

namespace ballbar::python {
namespace {

namespace py = pybind11;

using Texts = std::map<std::string, std::vector<std::string>>;  // empty: not known
using Columns = std::map<std::string, Numbers>;                 // NaN: not known

// A quantity, its unit, and the names of its columns.
struct Quantity {
  std::string name, unit;
  const double *value = nullptr, *sigma = nullptr;
};

// `what` it holds: numbers, texts.
template <class Kind>
const auto& column(const Kind& columns, const std::string& name, std::size_t rows, const char* what) {
  const auto found = columns.find(name);
  if (found == columns.end() || static_cast<std::size_t>(found->second.size()) != rows) {
    throw Error(fmt::format("{}: expected a column of {} {}.", name, rows, what));
  }
  return found->second;
}

Plane plane_of(const std::string& name) {
  for (const Plane plane : kPlanes) {
    if (name_of(plane) == name) return plane;
  }
  throw Error(fmt::format("plane: expected XY, YZ or ZX (or XZ and the like), found {}.", name));
}

std::vector<MachineTest> tests_of(const Texts& texts, const Columns& columns,
                                  const std::vector<std::pair<std::string, std::string>>& names) {
  if (!texts.contains("file")) throw Error("file: expected a column of texts, found none.");
  const std::size_t rows = texts.at("file").size();
  const auto text = [&](const char* name) -> const auto& { return column(texts, name, rows, "texts"); };
  const auto number = [&](const std::string& name) { return column(columns, name, rows, "numbers").data(); };
  std::vector<Quantity> quantities;
  quantities.reserve(names.size());
  for (const auto& [name, unit] : names) {
    quantities.push_back({name, unit == "um_per_m" ? "um/m" : unit, number(fmt::format("{}_{}", name, unit)),
                          number(fmt::format("{}_{}_sigma", name, unit))});
  }
  const double *started_s = number("started_s"), *length_mm = number("length_mm"), *feed = number("feed_mm_per_min"),
               *start_deg = number("start_deg"), *arc_deg = number("arc_deg"), *stored = number("stored");
  std::vector<MachineTest> tests(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    MachineTest& test = tests[i];
    test.file = text("file")[i];
    test.machine = text("machine")[i];
    test.bar = text("bar")[i];
    test.plane = plane_of(text("plane")[i]);
    if (std::isfinite(started_s[i])) test.started_s = static_cast<std::int64_t>(std::llround(started_s[i]));
    test.nominal_length_mm = length_mm[i];
    if (std::isfinite(feed[i])) test.feed_mm_per_min = feed[i];
    test.start_deg = start_deg[i];
    test.arc_deg = arc_deg[i];
    test.stored = stored[i] > 0.0;
    for (const Quantity& one : quantities) {
      if (!std::isfinite(one.value[i])) continue;
      test.quantities.push_back({one.name, one.unit, one.value[i], one.sigma[i], one.name.starts_with("centre_")});
    }
  }
  return tests;
}

// The keys of its JSON, the text for a terminal, and the page where a title is given. `remarks`: on what the columns
// lack, printed below the conclusion.
py::tuple fleet(const Texts& texts, const Columns& columns,
                const std::vector<std::pair<std::string, std::string>>& quantities,
                const std::map<std::string, double>& tolerances, double false_discovery_rate,
                const std::optional<std::string>& title, const std::vector<std::string>& remarks) {
  HistoryOptions options;
  options.false_discovery_rate = false_discovery_rate;
  for (const auto& [name, limit] : tolerances) options.tolerances.push_back({name, -limit, limit});
  nlohmann::ordered_json json;
  std::string text, page;
  Listener(py::none()).hear([&] {
    const std::vector<MachineTest> tests = tests_of(texts, columns, quantities);
    options.every_quantity = std::all_of(
        tests.begin(), tests.end(), [&](const MachineTest& test) { return test.machine == tests.front().machine; });
    const History found = history_of(tests, options);
    json = json_of(found);
    text = ranking_text(found, false, remarks);
    if (title) {
      std::vector<std::filesystem::path> files;
      files.reserve(tests.size());
      for (const MachineTest& test : tests) files.emplace_back(test.file);
      page = ranking_page(*title, files, found, remarks);
    }
  });
  return py::make_tuple(to_python(json), text, page);
}

// The keys of the JSON of `errors`; no test at all is no error.
py::object tests(const std::vector<std::string>& files) {
  return to_python(Listener(py::none()).hear([&] { return json_of(tests_below(files, false)); }));
}

}  // namespace

void bind_fleets(py::module_& module) {
  module.def("tests", &tests, py::arg("files"));
  module.def(
      "machine_of_folder", [](const std::string& folder) { return machine_folder(folder).filename().string(); },
      py::arg("folder"));
  module.def("fleet", &fleet, py::arg("texts"), py::arg("numbers"), py::arg("quantities"), py::arg("tolerances"),
             py::arg("false_discovery_rate"), py::arg("title") = py::none(),
             py::arg("remarks") = std::vector<std::string>());
}

}  // namespace ballbar::python

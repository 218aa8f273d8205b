#include "history/found_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "history/machine_folder.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

// A tolerance on what no test has would never be met.
void expect_known(const std::vector<Tolerance>& tolerances, const std::vector<MachineTest>& tests) {
  if (tolerances.empty()) return;
  std::vector<std::string_view> names;
  for (const MachineTest& test : tests) {
    for (const TestQuantity& quantity : test.quantities) {
      if (!quantity.of_set_up) names.push_back(quantity.name);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  for (const Tolerance& tolerance : tolerances) {
    if (names.empty() || std::binary_search(names.begin(), names.end(), tolerance.quantity)) continue;
    throw Error(fmt::format("--tolerance: expected a quantity of these tests, found {}; the nearest is {}.",
                            in_quotes(tolerance.quantity), nearest_name(tolerance.quantity, names)));
  }
}

// Of several folders each is a machine, where its tests name none; those that are dates hold its tests.
void name_by_folder(std::vector<MachineTest>& tests, const std::vector<std::string>& folders) {
  if (folders.size() < 2) return;
  std::error_code error;
  const auto path_of = [](const std::string& folder) {
    return machine_folder((std::filesystem::path(folder) / "").lexically_normal().parent_path());
  };
  std::set<std::filesystem::path> names, paths;
  for (const std::string& folder : folders) {
    paths.insert(path_of(folder));
    names.insert(path_of(folder).filename());
  }
  for (const std::string& folder : folders) {
    if (!std::filesystem::is_directory(folder, error)) continue;
    const std::filesystem::path path = path_of(folder);
    const std::string name = (names.size() == paths.size() ? path.filename() : path).string();
    const std::string inside = folder.ends_with('/') ? folder : folder + '/';
    for (MachineTest& test : tests) {
      if (test.machine.empty() && test.file.starts_with(inside)) test.machine = name;
    }
  }
}

bool are_of_one_machine(const std::vector<MachineTest>& tests) {
  std::set<std::string_view> names;
  for (const MachineTest& test : tests) {
    if (!test.machine.empty()) names.insert(test.machine);
  }
  return names.size() < 2;
}

}  // namespace

FoundHistory found_history(TestFiles files, const std::vector<std::string>& folders, HistoryOptions how) {
  FoundHistory found{std::move(files), {}, std::nullopt};
  std::vector<MachineTest>& tests = found.files.tests;
  expect_known(how.tolerances, tests);
  name_by_folder(tests, folders);
  const bool of_one_machine = are_of_one_machine(tests);
  how.every_quantity = of_one_machine || are_stored(tests);
  found.history = history_of(tests, how);
  if (found.history.machines.size() == 1) found.geometry = machine_geometry(tests);
  return found;
}

}  // namespace ballbar

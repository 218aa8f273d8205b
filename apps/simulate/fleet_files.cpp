#include "simulate/fleet_files.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <set>
#include <string>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "simulate/simulated_files.hpp"

namespace ballbar {
namespace {

std::string fleet_day(std::int64_t time_s) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(time_s)));
}

// A number distinguishes two tests of a machine and plane on one day.
std::vector<std::filesystem::path> names_of(const std::vector<FleetTest>& tests) {
  std::vector<std::filesystem::path> names;
  std::set<std::filesystem::path> taken;
  for (const FleetTest& test : tests) {
    const std::string stem = fmt::format("{}-{}", fleet_day(test.started_s), name_of(test.plane));
    std::filesystem::path name = std::filesystem::path(test.machine_name) / (stem + ".b5r");
    for (int again = 2; !taken.insert(name).second; ++again) {
      name = std::filesystem::path(test.machine_name) / fmt::format("{}-{}.b5r", stem, again);
    }
    names.push_back(std::move(name));
  }
  return names;
}

std::string fleet_b5r(const VirtualFleet& fleet, const FleetCurves& curves, const FleetTest& test) {
  B5r file;
  file.test_name = fmt::format("SIMULATED by ballbar, not measured: {}", fleet.title);
  file.machine = test.machine_name;
  file.ballbar_model = "simulated";
  file.serial_number = test.bar;
  file.software_version = "ballbar simulate";
  file.runs = recordings_of(fleet, curves, test);
  return write_b5r(file);
}

std::string fleet_truth(const VirtualFleet& fleet) {
  constexpr double kFleetMonth_s = 365.25 * 86400.0 / 12.0;
  std::string text = "# SIMULATED by ballbar simulate, not measured.\nmachine,kind,from,error,amount\n";
  for (const FleetStory& event : fleet.stories) {
    const std::string start = fmt::format("{}-{:02},{},{}", fleet.machine_name, event.machine, name_of(event.kind),
                                          fleet_day(fleet.started_s + std::llround(event.month * kFleetMonth_s)));
    for (const auto& [name, amount] : event.errors) text += fmt::format("{},{},{}\n", start, name, amount);
    if (event.kind == StoryKind::instrument)
      text += fmt::format("{},bar {},{}\n", start, event.bar, event.bar_um_per_m);
  }
  return text;
}

}  // namespace

WrittenFleet write_fleet(const VirtualFleet& fleet, const std::filesystem::path& folder,
                         const std::filesystem::path& truth_file, bool replace) {
  if (folder.empty()) throw Error("Expected the name of a folder to write to, found an empty one.");
  const FleetCurves curves = fleet_curves(fleet);
  const std::vector<FleetTest> tests = fleet_tests(fleet, curves);
  const std::vector<std::filesystem::path> names = names_of(tests);
  expect_room({names.begin(), names.end()}, folder, truth_file, replace);
  std::set<std::string> machines;
  for (const FleetTest& test : tests) machines.insert(test.machine_name);
  for (const std::string& machine : machines) make_folder(folder / machine);
  in_parallel(tests.size(), [&](std::size_t i) { write_bytes(folder / names[i], fleet_b5r(fleet, curves, tests[i])); });
  make_folder(truth_file.parent_path());
  write_bytes(truth_file, fleet_truth(fleet));
  return {machines.size(), tests.size()};
}

}  // namespace ballbar

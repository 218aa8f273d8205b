#include "fleet/plant.hpp"

#include <fmt/format.h>

#include "ballbar/internal/numerics/parallel.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"

namespace ballbar::study {
namespace {

FindingKind kind_to_find(StoryKind kind) {
  switch (kind) {
    case StoryKind::wear:
      return FindingKind::trend;
    case StoryKind::crash:
      return FindingKind::step;
    case StoryKind::season:
      return FindingKind::season;
    case StoryKind::replaced_part:
      return FindingKind::replaced_part;
    case StoryKind::instrument:
      break;
  }
  return FindingKind::instrument;
}

}  // namespace

Plant plant_of(const VirtualFleet& fleet) {
  const FleetCurves curves = fleet_curves(fleet);
  const std::vector<FleetTest> tests = fleet_tests(fleet, curves);
  Plant plant;
  plant.tests.resize(tests.size());
  in_parallel(tests.size(), [&](std::size_t i) {
    const std::vector<Recording> recordings = recordings_of(fleet, curves, tests[i]);
    MachineTest& test = plant.tests[i] = machine_test(machine_errors(recordings), recordings);
    test.machine = tests[i].machine_name;
    test.bar = tests[i].bar;
    test.file = fmt::format("{}/{}.b5r", test.machine, i);
  });
  for (const FleetStory& story : fleet.stories) {
    plant.stories.push_back({fmt::format("{}-{:02}", fleet.machine_name, story.machine),
                             std::string(name_of(story.kind)), kind_to_find(story.kind)});
  }
  return plant;
}

}  // namespace ballbar::study

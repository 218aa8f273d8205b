#include "fleet/tally.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string>

namespace ballbar::study {
namespace {

std::string kinds_of(const MachineHistory& machine) {
  std::vector<std::string_view> kinds;
  for (const Finding& finding : machine.findings) kinds.push_back(name_of(finding.kind));
  return kinds.empty() ? "nothing" : fmt::format("{}", fmt::join(kinds, " "));
}

}  // namespace

PlantTally tally_of(const Plant& plant) {
  const History history = history_of(plant.tests);
  PlantTally tally;
  for (const MachineHistory& machine : history.machines) {
    bool has_story = false;
    if (!machine.findings.empty()) ++tally.called;
    for (const KnownStory& story : plant.stories) {
      if (story.machine != machine.name) continue;
      has_story = true;
      ++tally.stories;
      const bool found = std::any_of(machine.findings.begin(), machine.findings.end(),
                                     [&](const Finding& finding) { return finding.kind == story.kind; });
      if (found) {
        ++tally.found_stories;
      } else {
        tally.missed.push_back(fmt::format("{} ({})", story.name, kinds_of(machine)));
      }
    }
    if (!has_story && !machine.findings.empty()) {
      const QuantityHistory& series = machine.series[machine.findings.front().quantities.front().series];
      tally.others.push_back(fmt::format("{} {}", kinds_of(machine), series.name));
    }
  }
  return tally;
}

PlantTally tally_of_each(const Plant& plant) {
  std::map<std::string, Plant> machines;
  for (const MachineTest& test : plant.tests) machines[test.machine].tests.push_back(test);
  for (const KnownStory& story : plant.stories) machines[story.machine].stories.push_back(story);
  PlantTally sum;
  for (const auto& [name, machine] : machines) {
    const PlantTally one = tally_of(machine);
    sum.missed.insert(sum.missed.end(), one.missed.begin(), one.missed.end());
    sum.others.insert(sum.others.end(), one.others.begin(), one.others.end());
    sum.found_stories += one.found_stories;
    sum.stories += one.stories;
    sum.called += one.called;
  }
  return sum;
}

}  // namespace ballbar::study

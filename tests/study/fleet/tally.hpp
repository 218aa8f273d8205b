// What was found of a plant whose stories are known.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/history/history.hpp"

namespace ballbar::study {

struct KnownStory {
  std::string machine;
  std::string name;  // "wear"
  FindingKind kind = FindingKind::trend;
};

struct Plant {
  std::vector<MachineTest> tests;
  std::vector<KnownStory> stories;
};

struct PlantTally {
  std::vector<std::string> missed;  // "crash (nothing)", "replaced_part (step)"
  std::vector<std::string> others;  // machines without a story that were called, with the kind
  std::size_t found_stories = 0, stories = 0, called = 0;
};

PlantTally tally_of(const Plant& plant);

// Each machine judged alone; the sum.
PlantTally tally_of_each(const Plant& plant);

}  // namespace ballbar::study

// The tests in folders and the history of their machines, for `history` and the page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/history/history.hpp"
#include "errors/test_files.hpp"

namespace ballbar {

struct FoundHistory {
  TestFiles files;
  History history;
  std::optional<MachineGeometry> geometry;  // of one machine
};

// With several `folders`, tests without a machine name belong to the machine of their folder. A single machine has all
// quantities. Throws Error for a tolerance of an unknown quantity.
FoundHistory found_history(TestFiles files, const std::vector<std::string>& folders, HistoryOptions how);

}  // namespace ballbar

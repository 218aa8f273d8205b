// Tests of folders and what became of their machines, as `history` and the page find both.
#pragma once

#include <string>
#include <vector>

#include "ballbar/history/history.hpp"
#include "ballbar/history/machine_geometry.hpp"
#include "history/test_files.hpp"

namespace ballbar {

struct FoundHistory {
  TestFiles files;
  History history;
  MachineGeometry geometry;  // of one machine
};

// Tests that name no machine are of the folder they lie in, where there are several `folders`. Of one machine there is
// every quantity. Throws Error for a tolerance of what no test has.
FoundHistory found_history(TestFiles files, const std::vector<std::string>& folders, HistoryOptions how);

}  // namespace ballbar

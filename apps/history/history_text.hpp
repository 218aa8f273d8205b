// What `ballbar history` prints.
#pragma once

#include <string>
#include <vector>

#include "ballbar/history/history.hpp"
#include "history/test_files.hpp"

namespace ballbar {

// The conclusion, a table a group, squareness and scales, skipped files. `all`: quantities that say nothing too.
std::string history_text(const TestFiles& files, const std::vector<MachineHistory>& machines, bool all);

}  // namespace ballbar

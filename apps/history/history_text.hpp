// What `ballbar history` prints, and how it writes dates and groups in other formats.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ballbar/history/history.hpp"
#include "history/test_files.hpp"

namespace ballbar {

std::string date_text(double time_s);            // "2025-09-04"
std::string iso_date_text(std::int64_t time_s);  // "2025-09-04T16:10:49"
std::string group_text(const TestGroup& group);  // "XY, 100 mm, 1000 mm/min, 360 deg"

// The conclusion, a table a group, squareness and scales, skipped files. `all`: quantities that say nothing too.
std::string history_text(const TestFiles& files, const std::vector<MachineHistory>& machines, bool all);

}  // namespace ballbar

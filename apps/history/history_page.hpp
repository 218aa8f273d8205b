// The history as a page: apps/page/src/report.ts lists the keys.
#pragma once

#include <string>
#include <vector>

#include "ballbar/history/history.hpp"
#include "history/test_files.hpp"

namespace ballbar {

// Bytes of the .html. `title`: of the folder.
std::string history_page(const std::string& title, const TestFiles& files, const std::vector<MachineHistory>& machines);

}  // namespace ballbar

// Many machines as a page: apps/page/src/report.ts lists the keys.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ballbar/history/fleet.hpp"

namespace ballbar {

// Bytes of the .html: the ranking, and of each machine that is called its quantities over time, with what was found.
// `title`: of the folder or the table; `files`: that the tests were read from; `remarks`:
// sentences on what was not read.
std::string fleet_page(const std::string& title, const std::vector<std::filesystem::path>& files, const Fleet& fleet,
                       const std::vector<std::string>& remarks = {});

}  // namespace ballbar

// What a command did without.
#pragma once

#include <string>
#include <vector>

#include "ballbar/formats/recordings/test_folder.hpp"

namespace ballbar {

// "Left out: 2 files" and a line for each with its reason; empty where there is none.
std::string left_out_text(const std::vector<SkippedFile>& skipped);

}  // namespace ballbar

// Which machine the tests of a folder are of, where their files name none.
#pragma once

#include <filesystem>

namespace ballbar {

// The folder itself, or, of one named by a date ("2025-01-20", "20250120 after crash", "20.1.2025", "2025-W03"), which
// holds a test, the nearest above that is none; above a date a year alone is one too.
std::filesystem::path machine_folder(std::filesystem::path folder);

}  // namespace ballbar

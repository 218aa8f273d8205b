// The tests of a virtual fleet as files: a folder for each machine, a `.b5r` for each test, named by date and plane.
#pragma once

#include <cstddef>
#include <filesystem>

#include "ballbar/lab/simulation/virtual_fleet.hpp"

namespace ballbar {

struct WrittenFleet {
  std::size_t machines = 0, files = 0;
};

// Writes mill-07/2024-03-05-XY.b5r and so on, on all cores, and the stories into `truth_file`: machine, kind, date and
// errors, one row per story. The files state the name of the machine, the serial number of the bar, the date, and that
// they are simulated. Without `replace`, throws Error if the folder is not empty or the truth file exists. With
// `replace`, throws Error if an old `.b5r` in the folder would mix with the new ones.
WrittenFleet write_fleet(const VirtualFleet& fleet, const std::filesystem::path& folder,
                         const std::filesystem::path& truth_file, bool replace);

}  // namespace ballbar

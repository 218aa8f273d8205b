// The tests of a virtual fleet as files: a folder a machine, a `.b5r` a test, named by date and plane.
#pragma once

#include <cstddef>
#include <filesystem>

#include "ballbar/lab/simulation/virtual_fleet.hpp"

namespace ballbar {

struct WrittenFleet {
  std::size_t machines = 0, files = 0;
};

// mill-07/2024-03-05-XY.b5r and so on, written on all cores, and the stories into `truth_file`: machine, kind, date and
// errors, a row a story. The files state the machine's name, the bar's serial number and the date, and that they are
// simulated. Throws Error where the folder holds something or the truth file exists, and not `replace`; with `replace`,
// where a `.b5r` in the folder would stay and mix with the new ones.
WrittenFleet write_fleet(const VirtualFleet& fleet, const std::filesystem::path& folder,
                         const std::filesystem::path& truth_file, bool replace);

}  // namespace ballbar

// A test from a `.b5r` with stored results only, and the limits in the file, with the names and units of MachineErrors.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/history/history.hpp"

namespace ballbar {

// The stored values, without sigma; without quantities if none of these is stored.
MachineTest stored_test(const B5r& b5r);

// AF_CIRCULARITY in um: of the diagnosis, which is the largest of the runs; else the largest of the runs.
std::optional<StoredFeature> stored_circularity(const B5r& b5r);

// The limits of quantities of the machine; of a warning and a failing limit the failing one.
std::vector<Tolerance> stated_tolerances(const B5r& b5r);

}  // namespace ballbar

// Squareness and scales of a machine, for the terminal.
#pragma once

#include <string>

#include "ballbar/history/machine_geometry.hpp"
#include "history/test_files.hpp"

namespace ballbar {

// Empty where no test tells them. Places of the geometry are those in files.tests.
std::string geometry_text(const TestFiles& files, const MachineGeometry& geometry);

}  // namespace ballbar

// Squareness and scales of a machine, for the terminal and the page.
#pragma once

#include <string>
#include <vector>

#include "ballbar/history/machine_geometry.hpp"
#include "history/test_files.hpp"

namespace ballbar {

struct GeometryTexts {
  std::string heading;
  std::vector<std::vector<std::string>> rows;  // what, um/m, from
  std::vector<std::string> sentences;          // whether the tests agree, and what scales are against
};

GeometryTexts geometry_texts(const TestFiles& files, const MachineGeometry& geometry);

// Empty where no test tells them. Places of the geometry are those in files.tests.
std::string geometry_text(const TestFiles& files, const MachineGeometry& geometry);

}  // namespace ballbar

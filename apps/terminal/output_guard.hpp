// What a command may write over.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ballbar {

// Throws Error where an output is one of the inputs: a measurement is not written over.
void expect_no_input(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs);

}  // namespace ballbar

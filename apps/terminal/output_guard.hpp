// What a command may write over.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

// Throws Error where an output is one of the inputs: a measurement is not written over.
// `option`: that named the outputs.
void expect_no_input(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs,
                     std::string_view option = "--out");

}  // namespace ballbar

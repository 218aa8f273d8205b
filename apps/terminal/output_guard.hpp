// Protects input files from being overwritten.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

// Throws Error if an output is one of the inputs, so that a measurement is never overwritten.
// `option`: that named the outputs.
void expect_no_input(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs,
                     std::string_view option = "--out");

}  // namespace ballbar

// MATLAB .mat v5 by matio. In a build without it (BALLBAR_MAT=OFF) both functions throw an Error that says what to
// install.
#pragma once

#include <filesystem>
#include <string_view>

#include "ballbar/series/series.hpp"

namespace ballbar {

// Before anything is done for a file of that name.
void expect_mat(const std::filesystem::path& path);

// One variable a column, and method, reference_s, time_s. Throws Error where there is no room.
void write_mat(std::string_view method, double reference_s, const Series& series, const std::filesystem::path& path);

}  // namespace ballbar

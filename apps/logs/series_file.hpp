// A series to a file, in parts, so that a long one is not in memory a second time as text.
#pragma once

#include <filesystem>

#include "ballbar/series/series.hpp"

namespace ballbar {

void write_series_file(const Series& series, const std::filesystem::path& path);

}  // namespace ballbar

#include "logs/series_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "ballbar/error.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"

namespace ballbar {

void write_series_file(const Series& series, const std::filesystem::path& path) {
  constexpr std::size_t kRows = 1024;
  write_through(path, [&](const std::filesystem::path& temporary) {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file << series_header(series);
    const std::size_t rows = series.time_s.size();
    for (std::size_t row = 0; row < rows && file; row += kRows)
      file << write_rows(series, row, std::min(row + kRows, rows));
    file.close();
    if (!file) throw Error(fmt::format("{}: expected room to write {} rows, found none.", path.string(), rows));
  });
}

}  // namespace ballbar

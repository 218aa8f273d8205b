// Any bytes: read_series returns or throws Error; what it read can be written and read again.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/series/series_csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ballbar::Series series;
  try {
    series = ballbar::read_series(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
  } catch (const ballbar::Error&) {
    return 0;
  }
  ballbar::read_series(ballbar::write_series(series), "again");
  return 0;
}

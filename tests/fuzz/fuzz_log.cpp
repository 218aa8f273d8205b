// Any bytes: read_log returns or throws Error; the series of what it read can be written and read again.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/log.hpp"
#include "ballbar/formats/logs/recipe_toml.hpp"
#include "ballbar/formats/series/series_csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ballbar::Log log;
  try {
    log = ballbar::read_log(bytes, "fuzz");
  } catch (const ballbar::Error&) {
    return 0;
  }
  ballbar::read_series(ballbar::write_series(log.series), "again");
  ballbar::read_recipe(ballbar::write_recipe(log.recipe), "recipe");
  return 0;
}

// Any bytes: read_ballbar_log returns or throws Error, nothing else.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/ballbar_log.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    ballbar::read_ballbar_log(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
  } catch (const ballbar::Error&) {
  }
  return 0;
}

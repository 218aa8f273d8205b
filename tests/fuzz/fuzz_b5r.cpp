// Any bytes: read_b5r returns or throws Error, nothing else.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/b5r.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    ballbar::read_b5r(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
  } catch (const ballbar::Error&) {
  }
  return 0;
}

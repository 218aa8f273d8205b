// Any bytes: read_session_plan returns or throws Error, nothing else.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    ballbar::read_session_plan(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
  } catch (const ballbar::Error&) {
  }
  return 0;
}

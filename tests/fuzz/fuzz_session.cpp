// Any bytes: read_session_plan and read_run_list return or throw Error, nothing else.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/sessions/runs_toml.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    ballbar::read_session_plan(bytes, "fuzz");
  } catch (const ballbar::Error&) {
  }
  try {
    ballbar::read_run_list(bytes, "fuzz");
  } catch (const ballbar::Error&) {
  }
  return 0;
}

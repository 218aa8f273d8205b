// Any bytes: read_machine, read_shaft_images and read_fleet return or throw Error, nothing else.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ballbar/error.hpp"
#include "simulate/fleet_toml.hpp"
#include "simulate/machine_toml.hpp"
#include "simulate/shaft_images.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    ballbar::read_machine(bytes, "fuzz");
  } catch (const ballbar::Error&) {
  }
  try {
    ballbar::read_shaft_images(bytes, "fuzz");
  } catch (const ballbar::Error&) {
  }
  try {
    ballbar::read_fleet(bytes, "fuzz");
  } catch (const ballbar::Error&) {
  }
  return 0;
}

// Any bytes: holds_circle and read_circle_table return or throw Error, nothing else, with a stated radius and without.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/circle_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ballbar::holds_circle(bytes);
  for (const ballbar::StatedCircle& stated : {ballbar::StatedCircle{}, ballbar::StatedCircle{50.0}}) {
    try {
      ballbar::read_circle_table(bytes, "fuzz", stated);
    } catch (const ballbar::Error&) {
    }
  }
  return 0;
}

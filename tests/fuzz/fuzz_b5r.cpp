// Any bytes: read_b5r, and what writes and judges a test that it read, return or throw Error, nothing else.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/b5r.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const ballbar::B5r test = ballbar::read_b5r(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
    for (const ballbar::StoredFeature& stored : test.stored) {
      ballbar::judged(test.limits, stored.name, stored.value, stored.data_type);
    }
    ballbar::read_b5r(ballbar::write_b5r(test), "again");
  } catch (const ballbar::Error&) {
  }
  return 0;
}

// Any bytes: read_batch_model returns or throws Error; what it read can be written and read again, and is then the
// same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/batch_model_json.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ballbar::TemperatureRegression model;
  try {
    model = ballbar::read_batch_model(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
  } catch (const ballbar::Error&) {
    return 0;
  }
  const std::string written = ballbar::write_batch_model(model);
  if (ballbar::write_batch_model(ballbar::read_batch_model(written, "again")) != written) std::abort();
  return 0;
}

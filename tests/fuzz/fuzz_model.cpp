// Any bytes: read_model returns or throws Error; what it read can be written and read again, and is then the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/model_toml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ballbar::Model model;
  try {
    model = ballbar::read_model(bytes, "fuzz");
  } catch (const ballbar::Error&) {
    return 0;
  }
  const std::string written = ballbar::write_model(model);
  if (ballbar::write_model(ballbar::read_model(written, "again")) != written) std::abort();
  if (model.level != ballbar::Level::series) return 0;
  try {
    ballbar::read_model(ballbar::with_effect(bytes, "fuzz", ballbar::term_of("expansion", {"T_air_degC"})), "again");
  } catch (const ballbar::Error& error) {
    const std::string_view what = error.what();
    if (what.find("found an array.") == what.npos && what.find("at most 100") == what.npos) std::abort();
  }
  return 0;
}

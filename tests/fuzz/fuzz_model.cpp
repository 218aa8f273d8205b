// Any bytes: read_model returns or throws Error; what it read can be written and read again, and is then the same. A
// revision that is taken back leaves the bytes as they were.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_history.hpp"
#include "ballbar/formats/models/model_toml.hpp"

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
  try {
    const bool first = ballbar::read_ledger(bytes, "fuzz").empty();
    ballbar::LedgerRow row;
    row.change = "+ settling";
    const std::vector<ballbar::Term> added{ballbar::term_of("settling", {})};
    const std::string later = ballbar::with_revision(bytes, "fuzz", added, {}, ballbar::LedgerRow{}, row);
    const std::string before = ballbar::without_last_revision(later, "later");
    if (first && before != bytes) std::abort();
    if (!first) static_cast<void>(ballbar::without_last_revision(bytes, "fuzz"));
  } catch (const ballbar::Error&) {  // a history that a hand has been at, effects as an array, a hundred effects
  }
  return 0;
}

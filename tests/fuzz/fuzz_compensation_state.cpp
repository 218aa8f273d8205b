// Any bytes: read_compensation returns or throws Error; what it read can be written and read again, and is then the
// same. Where a compensator takes it, its offset keeps within the limits and moves by no more than a step a row.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/models/compensation_state.hpp"

namespace {

void expect(bool holds) {
  if (!holds) std::abort();
}

// Two columns, effects that keep numbers: that of the seeds.
ballbar::Model model() {
  ballbar::Model model;
  model.targets = {"z_um"};
  model.terms = {ballbar::term_of("lagged_expansion", {"T_a_degC"}), ballbar::term_of("speed_heating", {"speed_rpm"})};
  for (ballbar::Term& term : model.terms) term.settings[0].start = 2.0;
  return model;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ballbar::StoredCompensation stored;
  try {
    stored = ballbar::read_compensation(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
  } catch (const ballbar::Error&) {
    return 0;
  }
  const std::string written = ballbar::write_compensation(stored);
  expect(ballbar::write_compensation(ballbar::read_compensation(written, "again")) == written);
  static const ballbar::Model made = model();
  for (const ballbar::StoredAxis& axis : stored.axes) {
    ballbar::Compensator compensator(made, {});
    try {
      compensator.resume(axis.state, axis.live);
    } catch (const ballbar::Error&) {
      continue;
    }
    std::int64_t counts = axis.state.counts;
    for (int i = 0; i < 50; ++i) {
      const ballbar::Offset offset = compensator.next(100.0 + i, {{22.0 + 0.1 * i, 3000.0}});
      expect(std::abs(offset.counts - counts) <= 20);  // 2 um of 0.1 um
      expect(std::abs(offset.counts) <= 2000);
      expect(offset.hold == ballbar::Hold::none || offset.counts == counts);
      expect(std::isfinite(offset.predicted_um) == (offset.hold == ballbar::Hold::none));
      counts = offset.counts;
    }
    ballbar::Compensator next(made, {});
    next.resume(compensator.state(), compensator.model().state());
  }
  return 0;
}

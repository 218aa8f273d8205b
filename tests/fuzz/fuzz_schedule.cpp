// Any bytes: read_schedule_csv returns or throws Error, nothing else; what was read is written and read to the same,
// and its program and its check list are written.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/schedules/check_list.hpp"
#include "ballbar/formats/schedules/iso_program.hpp"
#include "ballbar/formats/schedules/schedule_csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ballbar::Schedule schedule;
  try {
    schedule = ballbar::read_schedule_csv(bytes, "fuzz");
  } catch (const ballbar::Error&) {
    return 0;
  }
  // Now nothing may be refused: an Error ends the fuzzing.
  const std::vector<ballbar::Dwell> again =
      ballbar::read_schedule_csv(ballbar::write_schedule_csv(schedule), "fuzz").dwells;
  if (again.size() != schedule.dwells.size()) std::abort();
  for (std::size_t i = 0; i < again.size(); ++i) {
    if (again[i].duration_s != schedule.dwells[i].duration_s) std::abort();
    if (again[i].speed_rpm != schedule.dwells[i].speed_rpm) std::abort();
  }
  for (const char c : ballbar::iso_program(schedule, bytes)) {
    if (c != '\n' && (c < 0x20 || c > 0x7E)) std::abort();
  }
  ballbar::check_list(schedule, {}, bytes);
  return 0;
}

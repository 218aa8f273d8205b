// Any bytes: read_schedule_csv and dry_run_of return or throw Error, nothing else; what was read is written and read to
// the same, and every control's program of it does that.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/schedules/dry_run.hpp"
#include "ballbar/formats/schedules/schedule_csv.hpp"
#include "ballbar/formats/schedules/spindle_program.hpp"

namespace {

void expect_same(const std::vector<ballbar::Dwell>& left, const std::vector<ballbar::Dwell>& right) {
  if (left.size() != right.size()) std::abort();
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i].duration_s != right[i].duration_s || left[i].speed_rpm != right[i].speed_rpm) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const ballbar::Dialect dialect : ballbar::kDialects) {
    try {
      ballbar::dry_run_of(bytes, dialect);
    } catch (const ballbar::Error&) {
    }
  }
  ballbar::Schedule schedule;
  try {
    schedule = ballbar::read_schedule_csv(bytes, "fuzz");
  } catch (const ballbar::Error&) {
    return 0;
  }
  // Now nothing may be refused: an Error ends the fuzzing.
  expect_same(ballbar::read_schedule_csv(ballbar::write_schedule_csv(schedule), "fuzz").dwells, schedule.dwells);
  for (const ballbar::Dialect dialect : ballbar::kDialects) {
    const std::string program = ballbar::spindle_program(schedule, dialect, {.ballbar = ballbar::BallbarTest{}});
    expect_same(ballbar::dry_run_of(program, dialect).dwells, ballbar::driven_dwells(schedule));
  }
  return 0;
}

#include "ballbar/formats/schedules/iso_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/formats/schedules/check_list.hpp"
#include "ballbar/formats/schedules/schedule_csv.hpp"
#include "ballbar/internal/number_text.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kLongestComment = 100;
constexpr long long kLongestBlock_ms = 300 * 1000;  // below what any control takes, and the comments say where it is

// Whatever stands in a text, it ends no comment and is no command.
std::string comment(std::string_view text) {
  std::string plain;
  for (const char c : text.substr(0, kLongestComment)) {
    const bool is_small = c >= 'a' && c <= 'z';
    const bool is_kept = is_small || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                         std::string_view("+-.,=").find(c) != std::string_view::npos;
    plain += is_small ? static_cast<char>(c - 'a' + 'A') : is_kept ? c : ' ';
  }
  return "(" + plain + ")\n";
}

std::string passed_min(long long time_ms) {
  return fmt::format("{}", std::round(static_cast<double>(time_ms) / 6e3) / 10.0);
}

}  // namespace

std::string iso_program(const Schedule& schedule, std::string_view title, std::optional<double> max_rpm) {
  expect_schedule(schedule);
  const auto ms_of = [](double time_s) { return std::llround(time_s * 1e3); };
  const long long total_ms = ms_of(duration_s(schedule));
  double highest_rpm = 0.0;
  for (const Dwell& dwell : schedule.dwells) highest_rpm = std::max(highest_rpm, dwell.speed_rpm);

  std::string out = "%\n" + comment("Spindle program of a thermal test, written by ballbar");
  if (!title.empty()) out += comment(fmt::format("Title {}", title));
  out += comment(fmt::format("{} dwells, {} in all, stops not counted", schedule.dwells.size(),
                             duration_text(duration_s(schedule))));
  out += comment(fmt::format("Highest speed {} rpm - the tool in the spindle must bear it", std::llround(highest_rpm)));
  out += comment("No axis moves");
  out += comment(schedule.starts_warm ? "Begin while the machine is still warm from what it did before"
                                      : "Begin after a night at rest");
  out += comment("G4 P is a dwell in seconds - some controls count in ms, or want X or F instead of P");
  out += "M5\nG4 P10\nM0 " + comment("Time it - go on if that was 10 s, else stop and change all dwells");

  Dwell before;
  double begin_s = 0.0;
  long long at_ms = 0, speed_rpm = 0;
  const auto turn = [&](long long rpm) {
    if (rpm != speed_rpm) out += rpm > 0 ? fmt::format("S{} M3\n", rpm) : "M5\n";
    speed_rpm = rpm;
  };
  for (std::size_t i = 0; i < schedule.dwells.size(); ++i) {
    const Dwell& dwell = schedule.dwells[i];
    const long long rpm = std::llround(dwell.speed_rpm);
    if (max_rpm && !(std::round(dwell.speed_rpm) <= *max_rpm)) {
      throw Error(
          fmt::format("Dwell {} of the schedule, from {:.4g} min: expected at most {} rpm, the highest that the "
                      "machine may turn, found {} rpm.",
                      i + 1, begin_s / 60.0, *max_rpm, dwell.speed_rpm));
    }
    out += comment(fmt::format("Dwell {} of {} - {} at {} rpm", i + 1, schedule.dwells.size(),
                               duration_text(dwell.duration_s), rpm));
    if (const std::string order = order_text(before, dwell); !order.empty()) {
      turn(0);  // nobody is asked to come near a spindle that turns
      out += "M0 " + comment("Set " + order);
    }
    turn(rpm);
    before = dwell;
    begin_s += dwell.duration_s;
    for (const long long end_ms = ms_of(begin_s); at_ms < end_ms;) {
      const long long block_ms = std::min(end_ms - at_ms, kLongestBlock_ms);
      at_ms += block_ms;
      out += fmt::format("G4 P{}\n", static_cast<double>(block_ms) / 1e3);
      out += comment(fmt::format("{} of {} min", passed_min(at_ms), passed_min(total_ms)));
    }
  }
  return out + "M5\nM30\n%\n";
}

}  // namespace ballbar

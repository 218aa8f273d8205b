// What a schedule may hold, for its reader and for what is made of it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ballbar/diagnosis/next_test/schedule.hpp"

namespace ballbar {

inline constexpr std::size_t kMostDwells = 10000;
inline constexpr double kShortestDwell_s = 1e-3;  // what controls can keep
inline constexpr double kLongestSchedule_s = 31.0 * 24.0 * 3600.0;

// A number of a dwell, as the file has it: its column, the value of a dwell, and what it may be.
struct DwellColumn {
  std::string_view name;
  double Dwell::*member = nullptr;
  double lowest = 0.0, highest = 0.0;
  std::string_view expected;  // after "expected"
};

inline constexpr std::array<DwellColumn, 4> kDwellColumns = {{
    {"speed_rpm", &Dwell::speed_rpm, 0.0, 1e6, "a speed of 0 to 1000000 rpm"},
    {"load", &Dwell::load, 0.0, 100.0, "a load of 0 to 100 times that of the data"},
    {"room_K", &Dwell::room_K, -100.0, 100.0, "a room within 100 K of that of the data"},
    {"coolant_K", &Dwell::coolant_K, -100.0, 100.0, "a coolant within 100 K of that of the data"},
}};
inline constexpr std::string_view kExpectedDuration = "a duration of 1 ms to 31 days";

bool within(const DwellColumn& column, double value);  // no for what is not finite
bool is_duration(double duration_s);

}  // namespace ballbar

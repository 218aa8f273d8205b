// Dates and times as loggers write them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ballbar {

inline constexpr double kDay_s = 86400.0;
inline constexpr double kUnixToExcel_d = 25569.0;  // days from 1899-12-30, a spreadsheet's first, to 1970

enum class DateOrder : std::uint8_t { day_first, month_first };

struct TimeStamp {
  std::optional<std::int64_t> day;   // since 1970-01-01, where a date stands
  std::optional<double> clock_s;     // since midnight, where a clock stands; above 86 400 where hours run on
  std::optional<double> zone_s;      // of the clock, east of Greenwich
  bool either_order = false;         // 03/04/2026: read by `order`, could be the other
  bool month_first_only = false;     // 11/22/2026: whatever `order` says
  bool day_first_only = false;       // 22/11/2026
  bool minutes_and_seconds = false;  // 05:10.3
  bool two_fields = false;           // 05:10
  bool elapsed = false;              // 1d 00:00:30, 0.5 sec, 26:15:00
  bool lacks_year = false;           // 03-04 08:15; the day is of 2001
};

// 2026-11-22T13:05:10.5+01:00, 22.11.2026 13:05:10,5, 11/22/2026 1:05:10 PM, 22-Nov-2026 13:05, 20261122 130510,
// 261122-130510, 2026年11月22日 13时05分10秒, 13:05:10.123, 13:05:10:123, 26:15:00, 1-05:30, PT5H30M, 05:10.3 ...;
// before a clock the year may lack: 22.11. 13:05, Nov 22 13:05. nullopt for all else. A year of two digits is of 1970
// to 2069. Dots: the day is first. `order` tells 03/04/2026.
std::optional<TimeStamp> time_stamp(std::string_view text, DateOrder order);

// AM, p.m.: beside a clock.
bool is_half_day(std::string_view word);

// "07:05:00" of "07.05.00", as clocks are written in Italian, Danish and Finnish; a fraction may follow, and hours may
// run on; "07.05" where seconds may be lacking. nullopt: it is none. It may be a date or a number as well.
std::optional<std::string> clock_of_dots(std::string_view text, bool may_lack_seconds = false);

}  // namespace ballbar

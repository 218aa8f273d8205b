#include "recordings/b5r_date.hpp"

#include <fmt/chrono.h>

#include <cmath>
#include <ctime>

#include "logs/time_stamp.hpp"

namespace ballbar {

std::optional<std::int64_t> date_s(std::string_view text) {
  const std::optional<TimeStamp> stamp = time_stamp(text, DateOrder::day_first);
  if (!stamp || !stamp->day || stamp->either_order || stamp->elapsed || stamp->minutes_and_seconds) return std::nullopt;
  return *stamp->day * std::int64_t{86400} + static_cast<std::int64_t>(std::floor(stamp->clock_s.value_or(0.0)));
}

std::string stored_date(std::int64_t local_time_s) {
  return fmt::format("{:%Y%m%d-%H%M%S}", fmt::gmtime(static_cast<std::time_t>(local_time_s)));
}

std::string iso_day(std::int64_t local_time_s) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(local_time_s)));
}

}  // namespace ballbar

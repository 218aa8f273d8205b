#include "recordings/b5r_date.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "logs/time_stamp.hpp"

namespace ballbar {
namespace {

std::chrono::year_month_day day_of(std::int64_t local_time_s) {
  return std::chrono::floor<std::chrono::days>(std::chrono::sys_seconds(std::chrono::seconds(local_time_s)));
}

}  // namespace

std::optional<std::int64_t> date_s(std::string_view text) {
  const std::optional<TimeStamp> stamp = time_stamp(text, DateOrder::day_first);
  if (!stamp || !stamp->day || stamp->either_order || stamp->elapsed || stamp->minutes_and_seconds) return std::nullopt;
  return *stamp->day * std::int64_t{86400} + static_cast<std::int64_t>(std::floor(stamp->clock_s.value_or(0.0)));
}

std::string stored_date(std::int64_t local_time_s) {
  const std::chrono::year_month_day ymd = day_of(local_time_s);
  const std::int64_t second =
      local_time_s - std::chrono::sys_seconds(std::chrono::sys_days(ymd)).time_since_epoch().count();
  return fmt::format("{:04}{:02}{:02}-{:02}{:02}{:02}", static_cast<int>(ymd.year()),
                     static_cast<unsigned>(ymd.month()), static_cast<unsigned>(ymd.day()), second / 3600,
                     second / 60 % 60, second % 60);
}

std::string iso_day(std::int64_t local_time_s) {
  const std::chrono::year_month_day ymd = day_of(local_time_s);
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(ymd.year()), static_cast<unsigned>(ymd.month()),
                     static_cast<unsigned>(ymd.day()));
}

}  // namespace ballbar

#include "recordings/b5r_date.hpp"

#include <fmt/format.h>

#include <chrono>

namespace ballbar {
namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

// What a date is read from, piece by piece; `ok` falls with the first that is not there.
struct DatePieces {
  std::string_view rest;
  bool ok = true;

  int number(std::size_t digits) {
    int value = 0;
    for (std::size_t i = 0; i < digits; ++i) {
      ok = ok && i < rest.size() && is_digit(rest[i]);
      if (ok) value = value * 10 + (rest[i] - '0');
    }
    if (ok) rest.remove_prefix(digits);
    return value;
  }

  void skip(char expected) {
    ok = ok && rest.starts_with(expected);
    if (ok) rest.remove_prefix(1);
  }
};

struct Clock {
  int hours = 0, minutes = 0, seconds = 0;
};

// 16:10 or 16:10:49.
Clock clock_of(DatePieces& pieces) {
  Clock clock;
  clock.hours = pieces.number(2);
  pieces.skip(':');
  clock.minutes = pieces.number(2);
  if (!pieces.rest.starts_with(':')) return clock;
  pieces.skip(':');
  clock.seconds = pieces.number(2);
  return clock;
}

// ".123", "Z", "+02:00", in this order, each where it stands.
void skip_zone(DatePieces& pieces) {
  if (pieces.rest.starts_with('.')) {
    pieces.skip('.');
    pieces.number(1);
    while (!pieces.rest.empty() && is_digit(pieces.rest.front())) pieces.rest.remove_prefix(1);
  }
  if (pieces.rest.starts_with('Z')) {
    pieces.skip('Z');
  } else if (pieces.rest.starts_with('+') || pieces.rest.starts_with('-')) {
    pieces.rest.remove_prefix(1);
    pieces.number(2);
    if (pieces.rest.starts_with(':')) pieces.skip(':');
    pieces.number(2);
  }
}

// Digits before the first sign that is none.
std::size_t leading_digits(std::string_view text) {
  std::size_t count = 0;
  while (count < text.size() && is_digit(text[count])) ++count;
  return count;
}

std::chrono::year_month_day day_of(std::int64_t local_time_s) {
  return std::chrono::floor<std::chrono::days>(std::chrono::sys_seconds(std::chrono::seconds(local_time_s)));
}

}  // namespace

std::optional<std::int64_t> date_s(std::string_view text) {
  DatePieces pieces{text};
  int year = 0, month = 0, day = 0;
  Clock clock;
  const std::size_t digits = leading_digits(text);
  if (digits == 8) {
    year = pieces.number(4);
    month = pieces.number(2);
    day = pieces.number(2);
    if (!pieces.rest.empty()) {
      pieces.skip('-');
      clock.hours = pieces.number(2);
      clock.minutes = pieces.number(2);
      clock.seconds = pieces.number(2);
    }
  } else if (digits == 4) {
    year = pieces.number(4);
    pieces.skip('-');
    month = pieces.number(2);
    pieces.skip('-');
    day = pieces.number(2);
    if (!pieces.rest.empty()) {
      pieces.skip(pieces.rest.starts_with('T') ? 'T' : ' ');
      clock = clock_of(pieces);
      skip_zone(pieces);
    }
  } else {
    day = pieces.number(digits == 1 ? 1 : 2);
    pieces.skip('.');
    month = pieces.number(leading_digits(pieces.rest) == 1 ? 1 : 2);
    pieces.skip('.');
    year = pieces.number(4);
    if (!pieces.rest.empty()) {
      pieces.skip(' ');
      clock = clock_of(pieces);
    }
  }
  if (!pieces.ok || !pieces.rest.empty()) return std::nullopt;
  if (clock.hours >= 24 || clock.minutes >= 60 || clock.seconds >= 60) return std::nullopt;
  const auto date = std::chrono::year(year) / std::chrono::month(static_cast<unsigned>(month)) /
                    std::chrono::day(static_cast<unsigned>(day));
  if (!date.ok()) return std::nullopt;
  const std::chrono::seconds midnight = std::chrono::sys_days(date).time_since_epoch();
  return midnight.count() + clock.hours * 3600 + clock.minutes * 60 + clock.seconds;
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

// Dates as `.b5r` files state them, or as other software rewrites them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ballbar {

// s since 1970-01-01T00:00:00 on the clock that the text is of: a date as a log may have it (time_stamp.hpp), such as
// YYYYMMDD-HHMMSS, with a clock or none; a fraction and a zone are not looked at. Nothing for all else: of 03/04/2026
// nobody knows which is the month.
std::optional<std::int64_t> date_s(std::string_view text);

// The instrument's own form, YYYYMMDD-HHMMSS.
std::string stored_date(std::int64_t local_time_s);

// The day alone, 2025-09-04.
std::string iso_day(std::int64_t local_time_s);

}  // namespace ballbar

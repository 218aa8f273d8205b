// How a number of a workbook is shown: as a date, a clock, a percentage.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ballbar {

enum class NumberFormat : std::uint8_t { plain, date, date_and_clock, clock, elapsed, percent };

// Of a format's code, "dd.mm.yyyy hh:mm", and of the codes that have no text but a number in every workbook.
NumberFormat number_format(std::string_view code);
NumberFormat built_in_number_format(int id);

// A number of days as it shows: "2026-11-22T13:05:10.500", "13:05:10.500", "26:15:00.000". `since_1904`: the calendar
// that some workbooks count from. Empty where it is no date.
std::string shown_days(double days, NumberFormat format, bool since_1904);

}  // namespace ballbar

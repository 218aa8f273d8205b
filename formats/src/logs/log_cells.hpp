// Cells of a log: possible types of a text, and its number.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ballbar {

std::string_view trimmed_cell(std::string_view cell);  // blanks, unbreakable ones too, and one pair of quotes off

// "", "NaN", "#NV", "---", "OVER", "BURNOUT" ...: no value; a name of it in `also` too.
bool is_missing(std::string_view cell, std::span<const std::string> also = {});

// "on", "TRUE", "open", "ein" ...: 1; "off", "false", "closed", "aus" ...: 0. What it is of a valve and of a circuit
// differs, but only the sign of an effect hangs on it.
std::optional<double> switch_value(std::string_view cell);

// The signs of a number; `other`: not a number.
struct NumberLook {
  enum class Kind { other, integer, comma, point, both };
  Kind kind = Kind::other;
  char decimal = '\0';     // if unambiguous: "0,125", "1.234,5", "12,5"
  bool thousands = false;  // possibly grouped by thousands: "1,234", "20.000"
};
NumberLook look_of(std::string_view cell);

// With `decimal`; grouped by thousands too, by blanks, ', or the other of comma and point.
std::optional<double> cell_number(std::string_view cell, char decimal);

}  // namespace ballbar

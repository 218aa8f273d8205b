// Normalises column names for comparison: lower case, no accents, blanks for all separators.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ballbar {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }  // of ASCII, whatever the locale

// Of ASCII too, so that a name is found in capitals or not.
constexpr char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
std::string small(std::string_view text);

// UTF-8 in, UTF-8 out. "Kühlmittel-Temp. [°C]" -> "kuhlmittel temp c". The degree sign, both micro signs, full-width
// forms and unbreakable blanks become what a keyboard has (blank, u, ASCII, blank); letters of other scripts stay.
std::string folded(std::string_view text);

// Folded, and parted where a capital follows a small letter: "GVL.rTempBed" -> "gvl r temp bed".
std::string parted(std::string_view name);

// The same as folded() but signs stay: "°C" -> "degc", "µm/min" -> "um/min", "min⁻¹" -> "min^-1". For units.
std::string folded_unit(std::string_view text);

// A list of words is one text with | between them. Whether `use` is true for one of them.
template <class Use>
bool any_word(std::string_view words, Use use) {
  while (true) {
    const std::size_t end = words.find('|');
    if (use(words.substr(0, end))) return true;
    if (end == std::string_view::npos) return false;
    words.remove_prefix(end + 1);
  }
}

inline bool is_one_of(std::string_view words, std::string_view key) {
  return any_word(words, [&](std::string_view word) { return word == key; });
}

}  // namespace ballbar

#include "logs/log_cells.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>

#include "logs/text_fold.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kNoBreak = "\xC2\xA0", kNarrowNoBreak = "\xE2\x80\xAF", kThin = "\xE2\x80\x89",
                           kMinus = "\xE2\x88\x92";

// One to three digits, then groups of three behind `separator`, then nothing or a decimal.
bool is_grouped(std::string_view digits, char separator) {
  const std::size_t first = digits.find(separator);
  if (first == std::string_view::npos || first == 0 || first > 3) return false;
  std::size_t at = first;
  while (at < digits.size() && digits[at] == separator) {
    if (at + 3 >= digits.size()) return false;
    for (std::size_t k = 1; k <= 3; ++k) {
      if (!is_digit(digits[at + k])) return false;
    }
    at += 4;
  }
  return at == digits.size();
}

// Unbreakable and thin blanks, and the ' of Swiss numbers, as blanks; a long minus as a short one.
std::string with_plain_signs(std::string_view cell) {
  std::string out;
  while (!cell.empty()) {
    const auto take = [&](std::string_view from, char to) {
      if (!cell.starts_with(from)) return false;
      out += to;
      cell.remove_prefix(from.size());
      return true;
    };
    if (take(kNoBreak, ' ') || take(kNarrowNoBreak, ' ') || take(kThin, ' ') || take(kMinus, '-') || take("’", ' '))
      continue;
    out += cell.front() == '\'' ? ' ' : cell.front();
    cell.remove_prefix(1);
  }
  if (out.size() > 2 && (out[0] == '+' || out[0] == '-') && out[1] == ' ') {  // "+ 20.78"
    out.erase(1, out.find_first_not_of(' ', 1) == std::string::npos ? 1 : out.find_first_not_of(' ', 1) - 1);
  }
  const std::size_t power = out.find_first_of("dD");  // of Fortran: 1.5D-02
  if (power != std::string::npos && power > 0 && (is_digit(out[power - 1]) || out[power - 1] == '.')) out[power] = 'E';
  return out;
}

std::string_view without_exponent(std::string_view text) {
  const std::size_t e = text.find_first_of("eE");
  if (e == std::string_view::npos) return text;
  std::string_view exponent = text.substr(e + 1);
  if (exponent.starts_with('+') || exponent.starts_with('-')) exponent.remove_prefix(1);
  const bool whole = !exponent.empty() && std::all_of(exponent.begin(), exponent.end(), is_digit);
  return whole ? text.substr(0, e) : std::string_view{};
}

std::string_view without_sign(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  return text;
}

}  // namespace

std::string_view trimmed_cell(std::string_view cell) {
  const auto trim = [&] {
    for (bool more = true; more;) {
      const std::size_t before = cell.size();
      while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
      while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t' || cell.back() == '\r')) cell.remove_suffix(1);
      if (cell.starts_with(kNoBreak)) cell.remove_prefix(2);
      if (cell.ends_with(kNoBreak)) cell.remove_suffix(2);
      more = cell.size() != before;
    }
  };
  trim();
  if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') {
    cell = cell.substr(1, cell.size() - 2);
    trim();
  }
  return cell;
}

bool is_missing(std::string_view cell, std::span<const std::string> also) {
  cell = trimmed_cell(cell);
  if (cell.empty() || std::find(also.begin(), also.end(), cell) != also.end()) return true;
  if (cell.find_first_not_of("-*#?._/ ") == std::string_view::npos) return true;  // ---, *****, ####
  if (cell.size() > 24) return false;
  constexpr std::string_view kTexts =
      "nan|na|n/a|#n/a|#na|#nv|nv|k.a.|null|none|nil|inf|-inf|+inf|infinity|-infinity|1.#inf|-1.#inf|1.#qnan|"
      "-1.#ind|1.#ind|1,#qnan|#value!|#wert!|#ref!|#bezug!|#div/0!|#num!|#zahl!|#null!|#valeur!|#valore!|#name?|"
      "#¡valor!|over|+over|-over|under|overrange|underrange|overload|+overload|overflow|+ovf|-ovf|ovf|ol|o.l|"
      "burnout|b.out|burn out|open|error|err|err.|fail|fault|fehler|invalid|bad|missing|fehlt|no data|nodata|"
      "off scale|off|<na>|nat|range|+range|-range|++++|----|undef|undefined|(null)|+oor|oor|-oor|--.-|leer|vide|"
      "vuoto|空|无|#n/v|nan(ind)|-nan(ind)|-nan|+++++|#n/d|n/d|#nd|断线|超量程|disconnected|not connected";
  const std::string key = folded_unit(cell);
  if (is_one_of(kTexts, key)) return true;
  return key.find_first_not_of('+') == std::string::npos;
}

std::optional<double> switch_value(std::string_view cell) {
  constexpr std::string_view kOn =
      "on|true|yes|open|opened|ein|an|auf|offen|ja|wahr|running|run|active|aktiv|oui|marche|vrai|si|acceso|aperto|"
      "vero|high|开|是|オン";
  constexpr std::string_view kOff =
      "off|false|no|close|closed|aus|zu|geschlossen|nein|falsch|stopped|stop|halt|stillstand|停止|inactive|inaktiv|non|"
      "arret|faux|"
      "spento|chiuso|falso|low|关|否|オフ";
  const std::string key = folded(trimmed_cell(cell));
  if (is_one_of(kOn, key)) return 1.0;
  if (is_one_of(kOff, key)) return 0.0;
  return std::nullopt;
}

NumberLook look_of(std::string_view cell) {
  NumberLook look;
  const std::string plain = with_plain_signs(trimmed_cell(cell));
  const std::string_view mantissa = without_exponent(plain);
  const bool exponent = mantissa.size() != plain.size();
  std::string_view digits = without_sign(mantissa);
  if (digits.empty()) return look;
  std::string packed(digits);
  if (digits.find(' ') != std::string_view::npos) {  // 12 345,6: grouped by blanks
    const std::size_t end = std::min(digits.find_first_of(",."), digits.size());
    if (!is_grouped(digits.substr(0, end), ' ')) return look;
    std::erase(packed, ' ');
    digits = packed;
  }
  if (!std::all_of(digits.begin(), digits.end(), [](char c) { return is_digit(c) || c == ',' || c == '.'; }))
    return look;
  if (std::none_of(digits.begin(), digits.end(), is_digit)) return look;
  const auto commas = std::count(digits.begin(), digits.end(), ','),
             points = std::count(digits.begin(), digits.end(), '.');
  if (commas == 0 && points == 0) {
    look.kind = NumberLook::Kind::integer;
    return look;
  }
  if (commas > 0 && points > 0) {  // the last one is the decimal, the other groups
    const char last = digits[digits.find_last_of(",.")], other = last == ',' ? '.' : ',';
    if (std::count(digits.begin(), digits.end(), last) > 1) return look;
    if (!is_grouped(digits.substr(0, digits.find(last)), other)) return look;
    look.kind = NumberLook::Kind::both;
    look.decimal = last;
    return look;
  }
  const char sign = commas > 0 ? ',' : '.';
  const bool grouped = !exponent && is_grouped(digits, sign) && digits.front() != '0';
  if (commas + points > 1) {
    if (!grouped) return look;
    look.decimal = sign == ',' ? '.' : ',';  // 1.234.567
  } else if (!grouped) {
    look.decimal = sign;
  }
  look.kind = sign == ',' ? NumberLook::Kind::comma : NumberLook::Kind::point;
  look.thousands = grouped;
  return look;
}

std::optional<double> cell_number(std::string_view cell, char decimal) {
  cell = trimmed_cell(cell);
  const auto parsed = [&](std::string_view text) -> std::optional<double> {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] =
        fast_float::from_chars_advanced(text.data(), text.data() + text.size(), value,
                                        fast_float::parse_options(fast_float::chars_format::general, decimal));
    const bool whole = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
    return whole ? std::optional(value) : std::nullopt;
  };
  if (const auto value = parsed(cell)) return value;
  const NumberLook look = look_of(cell);
  if (look.kind == NumberLook::Kind::other) return std::nullopt;
  if (look.decimal != '\0' && look.decimal != decimal) return std::nullopt;
  std::string packed = with_plain_signs(cell);
  std::erase(packed, ' ');
  std::erase(packed, decimal == ',' ? '.' : ',');
  return parsed(packed);
}

}  // namespace ballbar

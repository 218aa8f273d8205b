#include "recordings/circle_words.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "ballbar/units.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_units.hpp"
#include "logs/text_fold.hpp"

namespace ballbar {
namespace {

using Words = std::span<const std::string_view>;

constexpr std::string_view kAngle[] = {"angle", "winkel", "angolo",  "angulo", "phi", "theta", "alpha", "polar",
                                       "deg",   "degree", "degrees", "grad",   "rad", "gon",   "角度"};
constexpr std::string_view kLength[] = {"radius", "length", "laenge",  "lange",    "rayon",   "radio", "raggio",
                                        "r",      "l",      "abstand", "distance", "ballbar", "半径"};
constexpr std::string_view kDeviation[] = {"deviation", "dev",    "abweichung", "abw",        "delta",  "dr",
                                           "error",     "fehler", "ecart",      "desviacion", "scarto", "偏差"};
constexpr std::string_view kOfAngle[] = {"arcsec", "arcmin", "urad", "mrad", "sec", "arcseconds"};  // units
constexpr std::string_view kNumber[] = {"nr", "no", "n", "index", "idx", "sample", "point", "punkt", "count", "line"};
constexpr std::string_view kCommanded[] = {"soll",       "sollwert", "cmd", "command",   "commanded",
                                           "nominal",    "nom",      "ref", "reference", "prog",
                                           "programmed", "target",   "set", "setpoint"};
constexpr std::string_view kCcw[] = {"ccw", "g3", "g03", "gegen", "links", "left", "逆时针"};
constexpr std::string_view kCw[] = {"cw", "g2", "g02", "uhrzeigersinn", "rechts", "right", "顺时针"};
constexpr std::string_view kRadius[] = {"radius", "halbmesser", "rayon", "radio", "raggio", "半径"};
constexpr std::string_view kDiameter[] = {"diameter", "durchmesser", "diametre", "diametro", "直径"};
constexpr std::string_view kMeasured[] = {"best",   "actual",   "act",  "ist",       "fit",
                                          "fitted", "measured", "mean", "calculated"};
constexpr std::string_view kFeed[] = {"feedrate", "feed", "vorschub", "avance", "avanzamento", "进给"};
constexpr std::size_t kMostLines = 200, kLongestLine = 400;  // of a header that are looked at

bool is_in(Words words, std::string_view word) { return std::find(words.begin(), words.end(), word) != words.end(); }

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  const std::string key = folded(text);
  for (std::size_t at = 0; at < key.size();) {
    const std::size_t end = std::min(key.find(' ', at), key.size());
    if (end > at) words.push_back(key.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

bool has_word(std::string_view text, Words known) {
  const std::vector<std::string> words = words_of(text);
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) { return is_in(known, word); });
}

// The number that follows at `at`, after at most 12 signs that are none of a number.
struct NumberInText {
  double value = 0.0;
  std::string_view after;
};
std::optional<NumberInText> number_after(std::string_view line, std::size_t at) {
  constexpr std::string_view kOfNumber = "0123456789.,";
  const std::size_t first = line.find_first_of("0123456789", at);
  if (first == std::string_view::npos || first > at + 12) return std::nullopt;
  const std::size_t end = std::min(line.find_first_not_of(kOfNumber, first), line.size());
  std::string_view digits = line.substr(first, end - first);
  while (!digits.empty() && (digits.back() == '.' || digits.back() == ',')) digits.remove_suffix(1);
  const char decimal =
      digits.find(',') != std::string_view::npos && digits.find('.') == std::string_view::npos ? ',' : '.';
  const std::optional<double> value = cell_number(digits, decimal);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  return NumberInText{*value, line.substr(first + digits.size())};
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::optional<NumberInText> number_beside(const std::string& line, Words words) {
  for (const std::string_view word : words) {
    const std::size_t at = line.find(word);
    if (at == std::string::npos || (at > 0 && is_letter(line[at - 1]) && is_letter(word.front()))) continue;
    if (auto number = number_after(line, at + word.size())) return number;
  }
  return std::nullopt;
}

// "F1000", "R50", "R = 50".
std::optional<NumberInText> number_of_letter(const std::string& line, char letter) {
  for (std::size_t at = line.find(letter); at != std::string::npos; at = line.find(letter, at + 1)) {
    if (at > 0 && (is_letter(line[at - 1]) || is_digit(line[at - 1]))) continue;
    std::size_t next = line.find_first_not_of(" =:", at + 1);
    if (next == std::string::npos || !is_digit(line[next])) continue;
    return number_after(line, next);
  }
  return std::nullopt;
}

double mm_of(const NumberInText& number) {
  const std::vector<std::string> words = words_of(number.after.substr(0, 12));
  const std::string unit = words.empty() ? "" : words.front();
  if (unit == "um" || unit == "micron") return mm_from_um(number.value);
  if (unit == "in" || unit == "inch") return 25.4 * number.value;
  return unit == "m" ? 1e3 * number.value : number.value;
}

// The unit of a column; where it has none, what of its name could be one.
struct UnitWords {
  explicit UnitWords(const NumberColumn& column)
      : text(folded_unit(column.unit)), words(words_of(column.unit.empty() ? column.name : column.unit)) {}
  bool is(std::string_view name) const {
    return text == name || std::find(words.begin(), words.end(), name) != words.end();
  }

  std::string text;
  std::vector<std::string> words;
};

template <class Found>
auto first_of(const std::vector<std::string>& lines, Found found) -> decltype(found(std::string())) {
  for (std::size_t i = 0; i < std::min(lines.size(), kMostLines); ++i) {
    if (auto value = found(small(lines[i].substr(0, kLongestLine)))) return value;
  }
  return std::nullopt;
}

}  // namespace

std::optional<int> axis_of(const NumberColumn& column) {
  for (const std::string& word : words_of(column.name)) {
    const bool alone = word.size() == 1 || (word.size() == 2 && is_digit(word[1]));
    if (alone && word[0] >= 'x' && word[0] <= 'z') return word[0] - 'x';
  }
  return std::nullopt;
}

ColumnWord word_of(const NumberColumn& column) {
  if (is_time_name(column.name)) return ColumnWord::time;
  if (has_word(column.name, kAngle) || rad_per_unit(column)) return ColumnWord::angle;
  if (has_word(column.name, kOfAngle)) return ColumnWord::number;
  if (has_word(column.name, kDeviation)) return ColumnWord::deviation;
  if (has_word(column.name, kLength)) return ColumnWord::length;
  if (axis_of(column)) return ColumnWord::coordinate;
  if (has_word(column.name, kNumber)) return ColumnWord::number;
  return direction_of(column) ? ColumnWord::length : ColumnWord::none;
}

bool is_commanded(const NumberColumn& column) { return has_word(column.name, kCommanded); }

std::optional<Direction> direction_of(const NumberColumn& column) {
  if (has_word(column.name, kCcw)) return Direction::CCW;
  return has_word(column.name, kCw) ? std::optional(Direction::CW) : std::nullopt;
}

std::optional<double> mm_per_unit(const NumberColumn& column) {
  const UnitWords unit(column);
  if (unit.is("mm")) return 1.0;
  if (unit.is("um") || unit.is("micron") || unit.is("microns")) return 1e-3;
  if (unit.is("inch") || unit.is("in")) return 25.4;
  if (unit.is("nm")) return 1e-6;
  return unit.text == "m" ? std::optional(1e3) : std::nullopt;
}

std::optional<double> rad_per_unit(const NumberColumn& column) {
  const UnitWords unit(column);
  if (unit.is("rad") || unit.is("radian") || unit.is("radians")) return 1.0;
  if (unit.is("gon")) return kPi / 200.0;
  if (unit.is("deg") || unit.is("degree") || unit.is("degrees") || unit.is("grad")) return kPi / 180.0;
  return std::nullopt;
}

std::optional<double> seconds_per_unit(const NumberColumn& column) {
  if (const auto seconds = time_unit_s(column.unit)) return seconds;
  const std::vector<std::string> words = words_of(column.name);
  return words.empty() ? std::nullopt : time_unit_s(words.back());
}

std::optional<double> stated_radius_mm(const std::vector<std::string>& lines) {
  return first_of(lines, [](const std::string& line) -> std::optional<double> {
    if (has_word(line, kMeasured)) return std::nullopt;
    if (const auto number = number_beside(line, kDiameter)) return 0.5 * mm_of(*number);
    if (const auto number = number_beside(line, kRadius)) return mm_of(*number);
    if (const auto number = number_of_letter(line, 'r')) return mm_of(*number);
    return std::nullopt;
  });
}

std::optional<double> stated_feed_mm_per_min(const std::vector<std::string>& lines) {
  return first_of(lines, [](const std::string& line) -> std::optional<double> {
    auto number = number_beside(line, kFeed);
    if (!number) number = number_of_letter(line, 'f');
    if (!number || !(number->value > 0.0)) return std::nullopt;
    const bool in_metres = folded_unit(number->after.substr(0, 8)).starts_with("m/min");
    return in_metres ? 1e3 * number->value : number->value;
  });
}

std::optional<Plane> stated_plane(const std::vector<std::string>& lines) {
  return first_of(lines, [](const std::string& line) -> std::optional<Plane> {
    for (const std::string& word : words_of(line)) {
      if (word == "g17") return Plane::XY;
      if (word == "g18") return Plane::ZX;
      if (word == "g19") return Plane::YZ;
      for (const Plane plane : kPlanes) {
        if (word == small(name_of(plane))) return plane;
      }
    }
    return std::nullopt;
  });
}

}  // namespace ballbar

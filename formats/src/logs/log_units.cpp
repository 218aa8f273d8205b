#include "logs/log_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "logs/text_fold.hpp"
#include "text/cells.hpp"

namespace ballbar {
namespace {

constexpr double kInch_um = 25400.0;

struct Known {
  std::string_view texts;  // folded, blanks and ends of "[...]" taken off
  LogUnit unit;
};

constexpr Known kUnits[] = {
    // lengths
    {"um|mum|micron|microns|micrometer|micrometre|micrometers|mikrometer|mikron|mic|micron(s)|micro "
     "m|mkm|мкм|?m|\ufffdm|微米|ミクロン",
     {"um"}},
    {"nm", {"um", 1e-3}},
    {"mm|millimeter|millimeters|millimetre|millimetres|мм|毫米", {"um", 1e3}},
    {"in|inch|inches|zoll", {"um", kInch_um}},
    {"uin|microinch", {"um", kInch_um * 1e-6}},
    {"mil|thou", {"um", kInch_um * 1e-3}},
    {"cm", {"um", 1e4}},
    {"m|meter|meters|metre|metres", {"um", 1e6}},
    {"urad|um/m", {"urad"}},
    {"mrad", {"urad", 1e3}},
    // temperatures
    {"degc|deg c|grad c|c|celsius|degcelsius|deg celsius|grad celsius|degС|?c|\ufffdc|摄氏度|度", {"degC"}},
    {"degf|deg f|f|fahrenheit", {"degC", 5.0 / 9.0, -32.0 * 5.0 / 9.0}},
    {"k|kelvin|degk", {"K"}},
    {"mk", {"K", 1e-3}},
    // speeds of a spindle
    {"rpm|r/min|rev/min|revs/min|1/min|/min|min-1|min^-1|min**-1|u/min|upm|umdr/min|tr/min|tours/min|giri/min|g/min|об/"
     "мин|revolutions per minute|转/"
     "分|转/分钟|r/分|回転/分",
     {"rpm"}},
    {"rev/s|1/s", {"rpm", 60.0}},
    {"krpm", {"rpm", 1e3}},
    {"rad/s", {"rpm", 9.549296585513721}},  // 30 / pi
    // load
    {"a|amp|amps|ampere", {"A"}},
    {"ma", {"A", 1e-3}},
    {"w|watt|watts", {"W"}},
    {"kw", {"W", 1e3}},
    {"n.m|n*m|n m|newtonmeter", {"Nm"}},
    {"%|percent|pct|prozent|percentage", {"percent"}},
    // the rest
    {"bar", {"bar"}},
    {"mbar|hpa", {"bar", 1e-3}},
    {"kpa", {"bar", 1e-2}},
    {"mpa", {"bar", 10.0}},
    {"pa", {"bar", 1e-5}},
    {"psi", {"bar", 0.0689475729317831}},
    {"l/min|l_per_min|lpm|ltr/min|liter/min", {"l_per_min"}},
    {"l/h", {"l_per_min", 1.0 / 60.0}},
    {"mm/min|mm_per_min", {"mm_per_min"}},
    {"m/min", {"mm_per_min", 1e3}},
    {"deg/min|deg_per_min|°/min", {"deg_per_min"}},
    {"deg/s|deg_per_s|°/s", {"deg_per_min", 60.0}},
    {"mm/s", {"mm_per_min", 60.0}},
    {"in/min|ipm", {"mm_per_min", 25.4}},
    {"v|volt|volts|vdc", {"V"}},
    {"mv", {"V", 1e-3}},
};

struct KnownTime {
  std::string_view texts;
  double seconds;
};

constexpr KnownTime kTimes[] = {
    {"s|sec|secs|second|seconds|sek|sekunden|sekunde|secondes|segundos|secondi|с|сек|秒", 1.0},
    {"ms|msec|millis|milliseconds|毫秒|ミリ秒", 1e-3},
    {"us|usec", 1e-6},
    {"ns|nsec", 1e-9},
    {"min|mins|minute|minutes|minuten|minuti|minutos|мин|分|分钟", 60.0},
    {"h|hr|hrs|hour|hours|std|stunde|stunden|heures|horas|ore|ч|час|小时|時間", 3600.0},
    {"d|day|days|tag|tage|jours|giorni|dias|天", 86400.0},
};

// Line ends too: a cell in quotes may hold them.
std::string_view bare(std::string_view text) { return trimmed(text, " \t\r\n"); }

std::string_view without_brackets(std::string_view text) {
  constexpr std::pair<char, char> kPairs[] = {{'[', ']'}, {'(', ')'}, {'{', '}'}, {'<', '>'}};
  text = bare(text);
  for (const auto& [open, close] : kPairs) {
    if (text.size() > 1 && text.front() == open && text.back() == close) {
      return bare(text.substr(1, text.size() - 2));
    }
  }
  return text;
}

// "T_min" may be the least temperature: a unit of time stands in brackets or behind a word for time.
bool is_unit_of(std::string_view name, std::string_view text) {
  return log_unit(text) || (time_unit_s(text) && is_time_name(name));
}

// "Z 1/100 mm", "Z 0.01 mm": a fraction or a decimal before the unit belongs to it. "Probe 1 mm" is a name with a
// number.
std::optional<NameAndUnit> with_scale(std::string_view name, std::string_view unit) {
  const std::size_t at = name.find_last_of(" \t");
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view scale = name.substr(at + 1);
  const bool is_fraction = scale.starts_with("1/1") || scale.starts_with("0.") || scale.starts_with("0,");
  std::string both = std::string(scale) + " " + std::string(unit);
  if (!is_fraction || !scaled_unit(both)) return std::nullopt;
  return NameAndUnit{std::string(bare(name.substr(0, at))), std::move(both)};
}

// "timeSec", "seconds_elapsed", "Sekunden seit Start": a word for time, and one for its unit.
std::optional<NameAndUnit> with_worded_time(std::string_view header) {
  constexpr std::string_view kWords = "time|zeit|elapsed|since|seit|uptime|ticks|timestamp|duration|dauer|depuis|desde";
  bool is_time = false;
  std::optional<std::string> unit;
  const std::string key = parted(header);
  for (std::size_t at = 0; at < key.size();) {
    const std::size_t end = std::min(key.find(' ', at), key.size());
    const std::string_view word = std::string_view(key).substr(at, end - at);
    at = end + 1;
    is_time = is_time || is_one_of(kWords, word);
    if (word.size() > 1 && time_unit_s(word)) unit = word;
  }
  if (key.ends_with(" s")) unit = "s";
  return is_time && unit ? std::optional(NameAndUnit{std::string(header), *unit}) : std::nullopt;
}

// "Temp 1 [°C]", also with a bracket that is not known as a unit: "Temp 1 [avg]" keeps it in the name.
std::optional<NameAndUnit> with_brackets(std::string_view header) {
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}, std::pair{'{', '}'}}) {
    const std::size_t end = header.rfind(close);
    if (end == std::string_view::npos) continue;
    const std::size_t begin = header.rfind(open, end);
    if (begin == std::string_view::npos) continue;
    const std::string_view inside = bare(header.substr(begin + 1, end - begin - 1));
    if (!scaled_unit(inside) && !time_unit_s(inside)) continue;
    std::string name(bare(header.substr(0, begin)));
    const std::string_view after = bare(header.substr(end + 1));
    if (!after.empty()) name += (name.empty() ? "" : " ") + std::string(after);
    return NameAndUnit{name, std::string(inside)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<LogUnit> log_unit(std::string_view text) {
  text = without_brackets(text);
  if (text == "µ" || text == "μ") return LogUnit{"um"};    // U, folded the same, is a phase
  if (text == "Nm" || text == "NM") return LogUnit{"Nm"};  // nm is a length, Nm a torque
  if (text == "MPa") return LogUnit{"bar", 10.0};
  if (text == "mPa") return std::nullopt;
  const std::string key = folded_unit(text);
  for (const auto& [texts, unit] : kUnits) {
    if (is_one_of(texts, key)) return unit;
  }
  return std::nullopt;
}

std::optional<LogUnit> scaled_unit(std::string_view text) {
  if (const auto unit = log_unit(text)) return unit;
  text = without_brackets(text);
  for (const std::string_view times : {"x", "X", "*", "\u00D7"}) {  // "x0.1 degC"
    if (text.starts_with(times)) text = bare(text.substr(times.size()));
  }
  double scale = 0.0, divisor = 1.0;
  const auto number_at = [](std::string_view& from, double& number) {
    std::string point(from.substr(0, 24));  // "0,01 mm"
    std::replace(point.begin(), point.end(), ',', '.');
    const auto [rest, error] = std::from_chars(point.data(), point.data() + point.size(), number);
    from = bare(from.substr(static_cast<std::size_t>(rest - point.data())));
    return error == std::errc{};
  };
  if (!number_at(text, scale)) return std::nullopt;
  if (text.starts_with('/') && !log_unit(text)) {  // 1/100 mm, and 1000 /min
    text = bare(text.substr(1));
    if (!number_at(text, divisor)) return std::nullopt;
  }
  const double power = std::log10(scale / divisor);
  const auto unit = log_unit(text);
  // "[10 mm]" is the place of a sensor, or its range.
  const bool is_place = power > 0.5 && unit && unit->factor > 1.0;
  if (!unit || is_place || unit->offset != 0.0 || unit->canonical == "%" || !(std::abs(power) <= 6.0) ||
      std::abs(power - std::round(power)) > 1e-9)
    return std::nullopt;
  return LogUnit{unit->canonical, unit->factor * std::pow(10.0, std::round(power))};
}

LogUnit stated_unit(std::string_view text, std::string_view place) {
  if (text == "none") return {};
  if (const auto unit = scaled_unit(text)) return *unit;
  text = bare(text);
  double scale = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), scale);
  const auto unit = log_unit(text.substr(static_cast<std::size_t>(rest - text.data())));
  if (error == std::errc{} && unit && unit->offset == 0.0 && std::isfinite(scale) && scale != 0.0)
    return {unit->canonical, unit->factor * scale, 0.0};
  throw Error(fmt::format(
      "{}: expected a unit such as um, mm, degC, rpm, A, kW, bar or %, a scale such as 2.5um, or none, found {}.",
      place, in_quotes(text)));
}

std::optional<double> time_unit_s(std::string_view text) {
  std::string key = folded_unit(without_brackets(text));
  if (key.ends_with('.')) key.pop_back();  // "min.", "sek."
  for (const auto& [texts, seconds] : kTimes) {
    if (is_one_of(texts, key)) return seconds;
  }
  return std::nullopt;
}

bool is_time_name(std::string_view name) {
  constexpr std::string_view kNames =
      "time|t|zeit|temps|tempo|tiempo|hora|heure|ora|uhrzeit|elapsed|timestamp|zeitstempel|datetime|date time|date|"
      "datum|fecha|data|x value|elapsed time|time stamp|horodatage|messzeit|laufzeit|zeitpunkt|date et heure|"
      "data e ora|fecha y hora|date heure|data ora|fecha hora|datum zeit|datum uhrzeit|时间|日期|日期时间|時間|"
      "時刻|日時|日付|经过时间|経過時間|测量时间|采样时间|time of day|epoch|unix time|timestamp utc|clock|"
      "zeitachse|relative time|time elapsed|duration|dauer|采集时间|время|Время|日期 时间|日付 時刻|millis|micros";
  const std::string key = folded(name);
  return is_one_of(kNames, key);
}

NameAndUnit name_and_unit(std::string_view header) {
  header = bare(header);
  const std::string ascii = [&] {  // full-width brackets as narrow ones
    std::string text(header);
    for (const auto& [from, to] :
         {std::pair{"（", "("}, std::pair{"）", ")"}, std::pair{"［", "["}, std::pair{"］", "]"}}) {
      for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from)) text.replace(at, 3, to);
    }
    return text;
  }();
  if (auto both = with_brackets(ascii)) return *both;
  // "t/ms", "Load/%", "T1_degC", "x, µm", "Power in kW", "Temp °C": the last part is a unit, two letters or more, or a
  // sign, since "T A" may be a name.
  for (const std::string_view between : {" in ", " / ", "/", ", ", ",", "_", ".", " - ", " "}) {
    const bool first = between == "/";  // "Speed/U/min"
    const std::size_t at = first ? ascii.find(between) : ascii.rfind(between);
    if (at == std::string::npos || at == 0) continue;
    const std::string_view end = bare(std::string_view(ascii).substr(at + between.size()));
    const std::string_view before = std::string_view(ascii).substr(0, at);
    const bool one_letter = end.size() == 1 && end != "%" && !(time_unit_s(end) && is_time_name(before));  // "time s"
    if (!is_unit_of(before, end) || (one_letter && (between == " " || between == " - " || between == ".")) ||
        (between == " " && end == "in"))
      continue;
    const std::string_view name = bare(std::string_view(ascii).substr(0, at));
    if (const auto scaled = with_scale(name, end)) return *scaled;
    return {std::string(name), std::string(end)};
  }
  if (const auto time = with_worded_time(ascii)) return *time;
  // "Temp, °C (LBL: Bearing)"
  const std::size_t bracket = ascii.ends_with(')') ? ascii.rfind('(') : 0;
  if (bracket == 0 || bracket == std::string::npos) return {ascii, {}};
  NameAndUnit both = name_and_unit(std::string_view(ascii).substr(0, bracket));
  if (both.unit.empty()) return {ascii, {}};
  both.name += " " + ascii.substr(bracket);
  return both;
}

}  // namespace ballbar

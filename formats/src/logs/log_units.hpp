// Units as loggers and people write them, and their conversion to those of a series.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ballbar {

struct LogUnit {
  std::string_view canonical;  // as the name of a column ends: "um", "degC", "l_per_min"
  double factor = 1.0;         // canonical = factor value + offset
  double offset = 0.0;
};

// "°C", "[µm]", "1/min", "U/min", "l/min", "inch", "°F", "kW" ...; nullopt for what is no unit of the list. K is a
// temperature or a difference of two: it comes as "K", and the values tell (log_columns).
std::optional<LogUnit> log_unit(std::string_view text);

// The same of a header, where a power of ten may stand before it: "0.0001 in", "1/1000 mm", "10 um". The values are
// then in so many of the unit.
std::optional<LogUnit> scaled_unit(std::string_view text);

// What a user states: a unit of the list, a scale such as "2.5um" or "0.01 mm", or "none". Throws Error for anything
// else; `place` stands before it.
LogUnit stated_unit(std::string_view text, std::string_view place);

// Seconds in a unit of time: "s", "sec", "ms", "min", "h", "Std", "days" ...
std::optional<double> time_unit_s(std::string_view text);

// "Time", "t", "Zeit", "Datum/Uhrzeit", "temps", "时间" ...
bool is_time_name(std::string_view name);

// A header's text in its name and its unit: "Temp 1 [°C]", "Speed (rpm)", "Load/%", "T1_degC", "Power in kW",
// "Temp °C", "x µm". `unit` is empty where none is there.
struct NameAndUnit {
  std::string name, unit;
};
NameAndUnit name_and_unit(std::string_view header);

}  // namespace ballbar

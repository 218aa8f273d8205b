#include "logs/number_format.hpp"

#include <fmt/format.h>

#include <cmath>

#include "ballbar/formats/logs/log.hpp"
#include "logs/time_stamp.hpp"

namespace ballbar {
namespace {

constexpr double k1904_d = 1462.0;

std::string clock_text(double seconds) {
  const auto milli = static_cast<long long>(std::llround(seconds * 1e3));
  return fmt::format("{:02}:{:02}:{:02}.{:03}", milli / 3600000, milli / 60000 % 60, milli / 1000 % 60, milli % 1000);
}

}  // namespace

NumberFormat number_format(std::string_view code) {
  bool day = false, hour = false, second = false, elapsed = false, percent = false;
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i];
    if (c == '"') {  // text
      i = std::min(code.find('"', i + 1), code.size() - 1);
    } else if (c == '\\' || c == '_' || c == '*') {
      ++i;
    } else if (c == '[') {  // [h] is a clock that runs on; [Red], [$-407] are none
      const std::size_t end = std::min(code.find(']', i), code.size() - 1);
      const std::string_view inside = code.substr(i + 1, end - i - 1);
      elapsed = elapsed || inside == "h" || inside == "hh" || inside == "mm" || inside == "m" || inside == "s" ||
                inside == "ss";
      i = end;
    } else if (c == ';') {
      break;  // of negative numbers
    } else {
      day = day || c == 'd' || c == 'D' || c == 'y' || c == 'Y';
      hour = hour || c == 'h' || c == 'H';
      second = second || c == 's' || c == 'S';
      percent = percent || c == '%';
      if (c == 'G' || c == 'g') return NumberFormat::plain;  // General
    }
  }
  if (elapsed) return NumberFormat::elapsed;
  if (day) return hour || second ? NumberFormat::date_and_clock : NumberFormat::date;
  if (hour || second) return NumberFormat::clock;
  return percent ? NumberFormat::percent : NumberFormat::plain;
}

NumberFormat built_in_number_format(int id) {
  if (id == 9 || id == 10) return NumberFormat::percent;
  if (id == 22) return NumberFormat::date_and_clock;
  if ((id >= 14 && id <= 17) || (id >= 27 && id <= 31) || id == 36 || (id >= 50 && id <= 58)) return NumberFormat::date;
  if ((id >= 18 && id <= 21) || (id >= 32 && id <= 35) || id == 45 || id == 47) return NumberFormat::clock;
  if (id == 46) return NumberFormat::elapsed;
  return NumberFormat::plain;
}

std::string shown_days(double days, NumberFormat format, bool since_1904) {
  if (!(days >= 0.0 && days < 2958466.0)) return {};  // up to the year 9999
  if (format == NumberFormat::elapsed || (format == NumberFormat::clock && days < 1.0))
    return clock_text(days * kDay_s);
  const double date = days + (since_1904 ? k1904_d : 0.0);
  if (date < 1.0) return clock_text(days * kDay_s);
  const double seconds = std::round((date - kUnixToExcel_d) * kDay_s * 1e3) / 1e3;
  const std::string stamp = stamp_text(seconds);
  return format == NumberFormat::date && stamp.ends_with("T00:00:00") ? stamp.substr(0, 10) : stamp;
}

}  // namespace ballbar

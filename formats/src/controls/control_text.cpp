#include "controls/control_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace ballbar {
namespace {

constexpr double kMostSteps = 20.0;

double step_of(double span) {
  for (double decade = 0.1;; decade *= 10.0) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      if (span <= kMostSteps * digit * decade) return digit * decade;
    }
  }
}

}  // namespace

std::string comment_lines(std::string_view mark, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += mark;
    if (!line.empty()) text += ' ';
    for (const char c : line) text += c >= ' ' && c <= '~' ? c : '?';
    text += '\n';
  }
  return text;
}

std::vector<double> table_readings(const SensorSlope& sensor) {
  const double step = step_of(sensor.high - sensor.low);
  std::vector<double> readings{sensor.low};
  for (double k = std::floor(sensor.low / step) + 1.0; k * step < sensor.high; ++k) {
    const double reading = std::round(10.0 * k * step) / 10.0;
    if (reading > readings.back() && reading < sensor.high) readings.push_back(reading);
  }
  readings.push_back(sensor.high);
  return readings;
}

std::string decimal(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string formula(const LinearCompensation& line, const std::vector<std::string>& names, double factor,
                    int decimals) {
  std::string text;
  for (std::size_t j = 0; j < names.size(); ++j) {
    const SensorSlope& sensor = line.sensors[j];
    const std::string slope = decimal(factor * sensor.slope_um_per_K, decimals);
    const std::string zero = decimal(sensor.zero, 1);
    text += fmt::format("{}{}*({}{}{})", text.empty() || slope.front() == '-' ? "" : "+", slope, names[j],
                        zero.front() == '-' ? "+" : "-", zero.front() == '-' ? zero.substr(1) : zero);
  }
  return text;
}

}  // namespace ballbar

#include "errors/quantity_text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>

#include "terminal/terminal_table.hpp"

namespace ballbar {

std::string date_text(double time_s) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(std::floor(time_s))));
}

std::string iso_date_text(std::int64_t time_s) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(static_cast<std::time_t>(time_s)));
}

std::string several(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string signed_text(double value, int decimals) {
  const std::string text = fixed(value, decimals);
  return text.starts_with('-') ? text : '+' + text;
}

}  // namespace ballbar

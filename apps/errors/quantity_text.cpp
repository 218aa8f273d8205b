#include "errors/quantity_text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ctime>

#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

bool is_letter(char sign) { return std::isalnum(static_cast<unsigned char>(sign)) != 0; }

}  // namespace

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

std::string plain_name(std::string_view effect, Plane plane) {
  const std::string_view axes = name_of(plane);
  std::string of;
  if (effect.ends_with("_a") || effect.ends_with("_b")) {
    of = std::string(" of ") + axes[effect.back() == 'a' ? 0 : 1];
    effect.remove_suffix(2);
  }
  std::string name(effect);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name + of;
}

std::string with_axes(std::string_view summary, Plane plane) {
  const std::string_view axes = name_of(plane);
  std::string text(summary);
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool alone = (k == 0 || !is_letter(text[k - 1])) && (k + 1 == text.size() || !is_letter(text[k + 1]));
    if (alone && (text[k] == 'A' || text[k] == 'B')) text[k] = axes[text[k] == 'A' ? 0 : 1];
  }
  return text;
}

std::string measurement_text(const NextMeasurement& next) {
  return next.measurement == Measurement::other_direction ? "Measure the other direction."
         : next.measurement == Measurement::full_circle   ? "Measure a full circle."
                                                          : "Measure at another feed.";
}

}  // namespace ballbar

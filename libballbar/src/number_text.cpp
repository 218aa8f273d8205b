#include "ballbar/internal/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/message_catalogue.hpp"

namespace ballbar {

std::string duration_text(double duration_s) {
  constexpr double kMost_s = 1e9;  // what is absurd gets an exponent
  if (!std::isfinite(duration_s) || std::abs(duration_s) >= kMost_s) return fmt::format("{:.3g} s", duration_s);
  if (duration_s < 0.0) return "-" + duration_text(-duration_s);
  if (duration_s < 59.5) return fmt::format("{:.3g} s", duration_s);
  const auto in_parts = [](long long small, const char* large_unit, const char* small_unit) {
    const std::string large = fmt::format("{} {}", small / 60, large_unit);
    return small % 60 == 0 ? large : fmt::format("{} {} {}", large, small % 60, small_unit);
  };
  if (duration_s < 3599.5) return in_parts(std::llround(duration_s), "min", "s");
  if (duration_s < 100.0 * 3600.0 - 30.0) return in_parts(std::llround(duration_s / 60.0), "h", "min");
  return fmt::format("{} h", grouped_text(duration_s / 3600.0));
}

std::string grouped_text(double value) {
  std::string digits = fmt::format("{:.0f}", value);
  if (!std::isfinite(value) || std::abs(value) < 9999.5) return digits;
  const std::size_t first = value < 0.0 ? 1 : 0;
  for (std::size_t end = digits.size(); end > first + 3; end -= 3) digits.insert(end - 3, " ");
  return digits;
}

std::string percent_text(double p) { return text_of(percent_of(p)); }

Message percent_of(double p) {
  if (p >= 0.995) return messages::percent_over();
  if (p < 0.005) return messages::percent_under();
  return messages::percent(fmt::format("{:.0f}", 100.0 * p));
}

Message sure_of(double p) { return messages::sure(percent_of(p)); }

std::string p_text(double p) {
  constexpr double kLeast = 1e-6;
  if (p < kLeast) return "< 0.000001";
  if (!(p < 0.995)) return "1";
  return fmt::format("{:.{}f}", p, decimals_showing(2, p, 7));
}

std::string p_equals_text(double p) {
  const std::string text = p_text(p);
  return text.starts_with('<') ? "p " + text : "p = " + text;
}

int decimals_showing(int digits, double value, int most) {
  if (value == 0.0 || !std::isfinite(value)) return 2;
  return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, most);
}

int decimals_in(std::string_view unit) { return unit == "ms" ? 3 : unit == "um" ? 2 : 1; }

std::string size_text(double size_um) {
  return std::abs(size_um) < 99.5 ? fmt::format("{:.2g}", size_um) : grouped_text(size_um);
}

}  // namespace ballbar

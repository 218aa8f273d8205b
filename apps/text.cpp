#include "text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "ballbar/units.hpp"

namespace ballbar {
namespace {

// Characters of UTF-8 text; the tables hold letters and signs of one column each.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace

std::string Table::text() const { return aligned(true); }

std::string Table::left_aligned() const { return aligned(false); }

std::string Table::aligned(bool numbers) const {
  std::vector<std::size_t> width(rows_.front().size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], characters(row[i]));
  }
  std::string text;
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(width[i] - characters(row[i]), ' ');
      line += (i == 0 ? "" : "  ") + (i == 0 || !numbers ? row[i] + space : space + row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

std::string with_sigma(double value, double sigma, int decimals) {
  if (std::isinf(sigma)) return "undetermined";
  if (std::isnan(sigma)) return fixed(value, decimals) + " ± ?";
  return fmt::format("{} ± {:.{}f}", fixed(value, decimals), sigma, decimals);
}

std::string with_sigma(const Estimate& estimate, int decimals) {
  return with_sigma(estimate.value_um, estimate.sigma_um, decimals);
}

std::string fixed(double value, int decimals) {
  if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0.0;
  return fmt::format("{:.{}f}", value, decimals);
}

std::string duration_text(double duration_s) {
  if (duration_s < 120.0) return fmt::format("{:.3g} s", duration_s);
  const double duration_min = min_from_s(duration_s);
  return fmt::format("{:.{}f} min", duration_min, duration_min < 10.0 ? 1 : 0);
}

std::string shortened(const std::string& text, std::size_t width) {
  std::string line;
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      line += c;
    } else if (!line.ends_with(' ')) {
      line += ' ';
    }
  }
  if (characters(line) <= width) return line;
  std::size_t end = 0;
  for (std::size_t shown = 0; end < line.size(); ++end) {
    if ((static_cast<unsigned char>(line[end]) & 0xC0U) != 0x80U && ++shown > width - 3) break;
  }
  return line.substr(0, end) + "...";
}

std::string wrapped(const std::string& text, std::size_t width) {
  std::string lines;
  std::size_t start = 0;
  while (text.size() - start > width) {
    std::size_t end = text.rfind(' ', start + width);
    if (end == std::string::npos || end <= start) end = start + width;
    lines += text.substr(start, end - start) + '\n';
    start = end + 1;
  }
  return lines + text.substr(start) + '\n';
}

}  // namespace ballbar

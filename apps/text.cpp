#include "text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
  if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0.0;  // not "-0.00"
  if (std::isnan(sigma)) return fmt::format("{:.{}f} ± ?", value, decimals);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, sigma, decimals);
}

std::string with_sigma(const Estimate& estimate, int decimals) {
  return with_sigma(estimate.value_um, estimate.sigma_um, decimals);
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

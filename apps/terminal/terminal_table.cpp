#include "terminal/terminal_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <sstream>

#include "ballbar/units.hpp"

namespace ballbar {
namespace {

// A byte of UTF-8 that is not the first of its character.
bool is_within_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

// Characters of UTF-8 text; the tables hold letters and signs of one column each.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return !is_within_character(c); }));
}

}  // namespace

void Table::add_wrapped(std::vector<std::string> row, std::size_t width) {
  std::istringstream text(wrapped(row.back(), width));
  for (std::string line; std::getline(text, line);) {
    row.back() = line;
    add(row);
    std::fill(row.begin(), row.end(), "");
  }
}

std::string Table::text(std::size_t most) const { return aligned(true, most); }

std::string Table::left_aligned() const { return aligned(false, 10000); }

std::string Table::aligned(bool numbers, std::size_t most) const {
  constexpr std::size_t kNarrowest = 8;
  std::vector<std::size_t> width(rows_.front().size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], characters(row[i]));
  }
  const auto widest = [&] { return std::max_element(width.begin(), width.end()); };
  while (std::accumulate(width.begin(), width.end(), 2 * (width.size() - 1)) > most && *widest() > kNarrowest) {
    --*widest();
  }
  std::string text;
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string cell = characters(row[i]) > width[i] ? shortened(row[i], width[i]) : row[i];
      const std::string space(width[i] - characters(cell), ' ');
      line += (i == 0 ? "" : "  ") + (i == 0 || !numbers ? cell + space : space + cell);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

std::string with_sigma(double value, double sigma, int decimals) {
  if (std::isinf(sigma)) return "undetermined";
  return fmt::format("{} ± {}", fixed(value, decimals), std::isnan(sigma) ? "?" : fixed(sigma, decimals));
}

std::string with_sigma(const Estimate& estimate, int decimals) {
  return with_sigma(estimate.value_um, estimate.sigma_um, decimals);
}

std::string fixed(double value, int decimals) {
  constexpr double kTooLongToRead = 1e9;
  if (std::abs(value) >= kTooLongToRead) return fmt::format("{:.3g}", value);
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
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\xC2' && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0) {  // U+0080 to U+009F
      line += '?';
      ++i;
    } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      line += std::iscntrl(static_cast<unsigned char>(c)) == 0 ? c : '?';
    } else if (!line.ends_with(' ')) {
      line += ' ';
    }
  }
  if (characters(line) <= width) return line;
  std::size_t end = 0;
  for (std::size_t shown = 0; end < line.size(); ++end) {
    if (!is_within_character(line[end]) && ++shown > width - 3) break;
  }
  return line.substr(0, end) + "...";
}

std::string wrapped(const std::string& text, std::size_t width) {
  std::string lines;
  std::size_t start = 0;
  while (text.size() - start > width) {
    std::size_t end = text.rfind(' ', start + width);
    const bool at_space = end != std::string::npos && end > start;
    if (!at_space) {
      end = start + width;
      while (end > start + 1 && is_within_character(text[end])) --end;
    }
    lines += text.substr(start, end - start) + '\n';
    start = at_space ? end + 1 : end;
  }
  return lines + text.substr(start) + '\n';
}

}  // namespace ballbar

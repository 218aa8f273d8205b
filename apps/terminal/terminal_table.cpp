#include "terminal/terminal_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <sstream>
#include <string_view>
#include <utility>

namespace ballbar {
namespace {

// A byte of UTF-8 that is not the first of its character.
bool is_within_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

// Characters of UTF-8 text; the tables hold letters and signs of one column each.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return !is_within_character(c); }));
}

// Where a cell of at most `width` characters ends, in bytes, and how many bytes after that are dropped: at a space,
// else behind a sign within a name, both beyond the middle; else anywhere.
std::pair<std::size_t, std::size_t> break_of(const std::string& text, std::size_t width) {
  constexpr std::size_t kNone = std::string::npos;
  std::size_t at_space = kNone, at_bracket = kNone, at_sign = kNone, anywhere = 0, shown = 0;
  const auto is_one_of = [](std::string_view signs, char c) { return signs.find(c) != kNone; };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_within_character(text[i])) continue;
    if (text[i] == ' ' && 2 * shown > width) at_space = i;
    if (shown == width) {
      anywhere = i;
      break;
    }
    ++shown;
    if (2 * shown > width && is_one_of("(,", text[i])) at_bracket = i + 1;
    if (2 * shown > width && is_one_of("_/=:", text[i])) at_sign = i + 1;
  }
  if (at_space != kNone) return {at_space, 1};
  return {at_bracket != kNone ? at_bracket : at_sign != kNone ? at_sign : anywhere, 0};
}

// The lines of a cell; with an indent those after the first stand in by two.
std::vector<std::string> lines_of(std::string text, std::size_t width, bool indented) {
  std::vector<std::string> lines;
  const auto indent = [&] { return std::string(indented && !lines.empty() ? 2 : 0, ' '); };
  while (characters(text) + indent().size() > width) {
    const auto [end, dropped] = break_of(text, width - indent().size());
    lines.push_back(indent() + text.substr(0, end));
    text.erase(0, end + dropped);
  }
  lines.push_back(indent() + text);
  return lines;
}

std::string in_single_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

}  // namespace

std::size_t table_width(std::size_t elsewhere) {
  constexpr std::size_t kNarrowest = 60, kWidest = 400;
  winsize size{};
  if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return elsewhere;
  return std::clamp<std::size_t>(size.ws_col, kNarrowest, kWidest);
}

void Table::shorten(std::size_t most) {
  if (rows_.size() - 1 <= most) return;
  gap_ = (2 * most + 2) / 3;
  left_out_ = rows_.size() - 1 - most;
  const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(gap_ + 1);
  rows_.erase(first, first + static_cast<std::ptrdiff_t>(left_out_));
}

std::string more_text(std::size_t count, const std::string& what) {
  return fmt::format("... {} more {}{}; --details prints all", count, what, count == 1 ? "" : "s");
}

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

void Table::add_wrapped(std::vector<std::string> row, std::size_t width) {
  std::istringstream text(wrapped(row.back(), width));
  for (std::string line; std::getline(text, line);) {
    row.back() = line;
    add(row);
    std::fill(row.begin(), row.end(), "");
  }
}

std::string Table::text(std::size_t most) const { return aligned(true, most); }

std::string Table::left_aligned(std::size_t most) const { return aligned(false, most); }

std::string Table::aligned(bool numbers, std::size_t most) const {
  constexpr std::size_t kNarrowest = 12;
  std::vector<std::size_t> width(rows_.front().size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], characters(row[i]));
  }
  const auto widest = [&] { return std::max_element(width.begin(), width.end()); };
  while (std::accumulate(width.begin(), width.end(), 2 * (width.size() - 1)) > most && *widest() > kNarrowest) {
    --*widest();
  }
  std::string text;
  for (std::size_t at = 0; at < rows_.size(); ++at) {
    if (left_out_ > 0 && at == gap_ + 1) text += more_text(left_out_) + '\n';
    const auto& row = rows_[at];
    std::vector<std::vector<std::string>> cells;
    std::size_t lines = 1;
    cells.reserve(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      cells.push_back(lines_of(row[i], width[i], i == 0 || !numbers));
      lines = std::max(lines, cells.back().size());
    }
    for (std::size_t k = 0; k < lines; ++k) {
      std::string line;
      for (std::size_t i = 0; i < row.size(); ++i) {
        const std::string cell = k < cells[i].size() ? cells[i][k] : "";
        const std::string space(width[i] - characters(cell), ' ');
        line += (i == 0 ? "" : "  ") + (i == 0 || !numbers ? cell + space : space + cell);
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + '\n';
    }
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

std::string one_line(const std::string& text) {
  constexpr std::size_t kNobodyReads = 300;
  return shortened(text, kNobodyReads);
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

std::string left_out_text(const std::vector<SkippedFile>& skipped) {
  if (skipped.empty()) return {};
  std::string text =
      fmt::format("Left out: {}\n", skipped.size() == 1 ? "one file" : fmt::format("{} files", skipped.size()));
  for (const SkippedFile& one : skipped) text += fmt::format("  {}\n", shortened(one.why, 1000));
  return text;
}

std::string shell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./=:,+@%").find(c) != std::string::npos;
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), is_plain) ? text : in_single_quotes(text);
}

void add_details(CLI::App& command, bool& details) {
  command.add_flag("--details", details, "print everything: whole tables, and what the figures mean");
}

std::string on_a_screen(const std::vector<ScreenPart>& parts, bool details) {
  std::string whole;
  std::size_t lines = 2;  // with those of the last paragraph, on columns that are left out
  const auto append = [](std::string& text, const std::string& part) {
    if (!part.empty()) text += (text.empty() ? "" : "\n") + part;
  };
  for (const ScreenPart& part : parts) {
    append(whole, part.text);
    if (part.what.empty() && !part.text.empty()) lines += lines_in(part.text) + 1;
  }
  if (details || lines_in(whole) <= kScreenLines) return whole;
  std::string text;
  std::vector<std::string> left_out;
  for (const ScreenPart& part : parts) {
    const std::size_t longer = lines + lines_in(part.text) + 1;
    if (part.text.empty() || part.what.empty()) {
      append(text, part.text);
    } else if (longer <= kScreenLines) {
      append(text, part.text);
      lines = longer;
    } else {
      left_out.push_back(part.what);
    }
  }
  if (!left_out.empty()) append(text, details_text(fmt::format("{}", fmt::join(left_out, ", "))));
  return text;
}

std::string details_text(std::string_view what) { return wrapped(fmt::format("--details shows {}.", what)); }

std::string wrapped(const Paragraph& paragraph) { return wrapped(text_of(paragraph)); }

}  // namespace ballbar

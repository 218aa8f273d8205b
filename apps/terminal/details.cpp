#include "terminal/details.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "terminal/terminal_table.hpp"

namespace ballbar {

void add_details(CLI::App& command, bool& details) {
  command.add_flag("--details", details, "print everything: whole tables, and what the figures mean");
}

std::string on_a_screen(const std::vector<ScreenPart>& parts, bool details) {
  std::string whole;
  std::size_t lines = 2;  // with those of the last paragraph, which says what is left out
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

}  // namespace ballbar

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
  std::size_t lines = 2;  // of the last paragraph
  for (const ScreenPart& part : parts) {
    if (part.what.empty()) lines += lines_in(part.text) + 1;
  }
  std::string text;
  std::vector<std::string> left_out;
  for (const ScreenPart& part : parts) {
    if (part.text.empty()) continue;
    if (!part.what.empty() && !details) {
      const std::size_t longer = lines + lines_in(part.text) + 1;
      if (longer > kScreenLines) {
        left_out.push_back(part.what);
        continue;
      }
      lines = longer;
    }
    text += (text.empty() ? "" : "\n") + part.text;
  }
  if (!left_out.empty()) text += "\n" + details_text(fmt::format("{}", fmt::join(left_out, ", ")));
  return text;
}

std::string details_text(std::string_view what) { return wrapped(fmt::format("--details shows {}.", what)); }

}  // namespace ballbar

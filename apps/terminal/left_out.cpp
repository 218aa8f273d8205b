#include "terminal/left_out.hpp"

#include <fmt/format.h>

#include "terminal/terminal_table.hpp"

namespace ballbar {

std::string left_out_text(const std::vector<SkippedFile>& skipped) {
  if (skipped.empty()) return {};
  std::string text =
      fmt::format("Left out: {}\n", skipped.size() == 1 ? "one file" : fmt::format("{} files", skipped.size()));
  for (const SkippedFile& one : skipped) text += fmt::format("  {}\n", shortened(one.why, 1000));
  return text;
}

}  // namespace ballbar

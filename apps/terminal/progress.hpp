// How far a command is: one line on the terminal, which the next one replaces. Nothing is written where standard error
// is no terminal, and nothing ever to standard output.
#pragma once

#include <string_view>

namespace ballbar {

void show_progress(std::string_view line);  // empty: takes the line away

// Takes the line away when a command ends, by an error too.
struct ProgressLine {
  ProgressLine() = default;
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { show_progress({}); }
};

}  // namespace ballbar

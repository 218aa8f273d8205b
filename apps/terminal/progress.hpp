// How far a command is: one line, which the next one replaces. On a terminal it is shown there, and nothing is written
// where standard error is none; a program that called takes it. Nothing ever to standard output.
#pragma once

#include <string_view>

namespace ballbar {

void show_progress(std::string_view line);  // empty: takes the line away

// Whether somebody takes lines that are not for reading: JSON, with what is known so far.
bool progress_is_taken();

// Takes the line away when a command ends, by an error too.
struct ProgressLine {
  ProgressLine() = default;
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { show_progress({}); }
};

}  // namespace ballbar

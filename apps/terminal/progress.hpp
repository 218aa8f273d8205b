// The progress of a command: one line, which the next one replaces. It is shown if standard error is a terminal, or is
// passed to the calling program. It never goes to standard output.
#pragma once

#include <string_view>

namespace ballbar {

void show_progress(std::string_view line);  // empty: takes the line away

// Whether the caller takes progress as JSON with the results so far.
bool progress_is_taken();

// Removes the line when a command ends, also after an error.
struct ProgressLine {
  ProgressLine() = default;
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { show_progress({}); }
};

}  // namespace ballbar

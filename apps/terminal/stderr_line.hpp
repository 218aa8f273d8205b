// Prints a line on the standard error. Never throws: a failure to print does not stop the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

void stderr_line(const std::string& text);

// "wrote drift.csv"
void wrote_line(const std::string& file);

// A line each, after "ballbar: ".
void tell(const std::vector<std::string>& remarks);
// With "ballbar: " in front, in red: an error.
void error_line(const std::string& text);

// The line in yellow: a warning about completed work.
void warning_line(const std::string& text);

// For the standard output. Colour where a person reads: only on a terminal that is not dumb, and not where NO_COLOR is
// set (no-color.org). What goes to a file, a pipe or a program stays plain.
std::string bold(const std::string& text);

// The progress of a command: one line, which the next one replaces. It is shown if standard error is a terminal, or is
// passed to the calling program. It never goes to standard output.
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

// Tables for the terminal: aligned, with units in the heading.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/formats/recordings/test_folder.hpp"
#include "ballbar/message.hpp"

namespace CLI {
class App;
}

namespace ballbar {

// First row is the heading. The first column is aligned to the left, the others to the right.
class Table {
 public:
  explicit Table(std::vector<std::string> heading) : rows_{std::move(heading)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  // Keeps the first and the last rows where there are more than `most`, with a line between them such as
  // "... 120 more rows; --details prints all".
  void shorten(std::size_t most);
  void add_wrapped(std::vector<std::string> row, std::size_t width);  // wraps the last cell
  // If rows exceed `most` characters, the widest column is narrowed, then the next, and its cells are wrapped.
  std::string text(std::size_t most = 10000) const;
  std::string left_aligned(std::size_t most = 10000) const;  // all columns to the left: tables of words

 private:
  std::string aligned(bool numbers, std::size_t most) const;
  std::vector<std::vector<std::string>> rows_;
  std::size_t gap_ = 0, left_out_ = 0;  // rows left out below this one
};

// "... 120 more rows; --details prints all"
std::string more_text(std::size_t count, const std::string& what = "row");

constexpr std::size_t kScreenLines = 40;  // the most that a command prints without --details

std::size_t lines_in(const std::string& text);

// Characters of a line: of the terminal, where the standard output is one.
std::size_t table_width(std::size_t elsewhere = 120);

// "7.40 ± 0.02"; the sigma is "?" if not known; "undetermined" if the readings do not determine the value.
std::string with_sigma(double value, double sigma, int decimals);
std::string with_sigma(const Estimate& estimate, int decimals = 2);

// "-0.00" is "0.00"; from 1e9 on "1.36e+12", whatever the decimals.
std::string fixed(double value, int decimals);

// One line of at most `width` characters, with "..." for omitted text and ? for control characters.
std::string shortened(const std::string& text, std::size_t width);

// A name with ? for control characters; only extremely long names are shortened.
std::string one_line(const std::string& text);

// Breaks at spaces so that no line is longer than `width`.
std::string wrapped(const std::string& text, std::size_t width = 100);
std::string wrapped(const Paragraph& paragraph);

// "Left out: 2 files" and a line for each with its reason; empty where there is none.
std::string left_out_text(const std::vector<SkippedFile>& skipped);

// As one word of a shell: in single quotes where it holds anything else than letters, digits and _-./=:,+@%.
std::string shell_word(const std::string& text);

// --details, of a command whose whole text is longer than a screen.
void add_details(CLI::App& command, bool& details);

// "--details shows the whole table and the tests.": the last line of a text that left something out.
std::string details_text(std::string_view what);

// Lines between two empty lines, and what they hold, if a screen can do without them: "the contribution of each
// column".
struct ScreenPart {
  std::string text, what;
};

// The parts in their order; without `details` those that can be left out as far as they fit on a screen.
std::string on_a_screen(const std::vector<ScreenPart>& parts, bool details);

}  // namespace ballbar

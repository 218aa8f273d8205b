// One screen unasked, the rest by --details.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace ballbar {

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

// One screen unasked, the rest by --details.
#pragma once

#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace ballbar {

// --details, of a command whose whole text is longer than a screen.
void add_details(CLI::App& command, bool& details);

// "--details shows the whole table and the tests.": the last line of a text that left something out.
std::string details_text(std::string_view what);

}  // namespace ballbar

// One good text a reader, and the reading of it with one place changed: for tables of bad text.
#pragma once

#include <string>
#include <string_view>

namespace ballbar {

// A good text of the kind "log", "axial", "series", "probes" (a series), "session", "rotation" (a session), "b5r" or
// "both" (a .b5r of both runs with a whole head).
std::string good_text(std::string_view kind);

// good_text with every `from` replaced by `to`; `to` alone where `from` is "*".
std::string changed(std::string_view kind, std::string_view from, std::string_view to);

// Reads the text with the reader of that kind, as a file called "file".
void read(std::string_view kind, std::string_view text);

}  // namespace ballbar

// The whole tool as one HTML file, which is installed beside the program or lies in its tree.
#pragma once

#include <string>

namespace ballbar {

// Copies it to `out` and prints what it is for. Throws Error: this program was built without it, or `out` cannot be
// written.
void write_tool_page(const std::string& out);

}  // namespace ballbar

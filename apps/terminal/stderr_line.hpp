// A line on the standard error. Never throws: that nobody can read it is no reason to stop.
#pragma once

#include <string>

namespace ballbar {

void stderr_line(const std::string& text);

}  // namespace ballbar

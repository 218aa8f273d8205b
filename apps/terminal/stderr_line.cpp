#include "terminal/stderr_line.hpp"

#include <cstdio>

namespace ballbar {

void stderr_line(const std::string& text) { std::fputs((text + "\n").c_str(), stderr); }

}  // namespace ballbar

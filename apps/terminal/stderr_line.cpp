#include "terminal/stderr_line.hpp"

#include <cstdio>

#include "terminal/colour.hpp"

namespace ballbar {

void stderr_line(const std::string& text) { std::fputs((text + "\n").c_str(), stderr); }

void error_line(const std::string& text) { stderr_line(red("ballbar:") + " " + text); }

void warning_line(const std::string& text) { stderr_line(yellow(text)); }

}  // namespace ballbar

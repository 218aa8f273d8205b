// Colour where a person reads: only on a terminal that is not dumb, and not where NO_COLOR is set (no-color.org). What
// goes to a file, a pipe or a program stays plain.
#pragma once

#include <cstdio>
#include <string>

namespace ballbar {

bool is_coloured(std::FILE* stream);

std::string bold(const std::string& text, std::FILE* stream = stdout);
std::string red(const std::string& text, std::FILE* stream = stderr);
std::string yellow(const std::string& text, std::FILE* stream = stderr);

}  // namespace ballbar

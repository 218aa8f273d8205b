#include "terminal/colour.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace ballbar {
namespace {

std::string value_of(const char* variable) {
  const char* const value = std::getenv(variable);
  return value == nullptr ? "" : value;
}

std::string in_colour(std::string_view code, const std::string& text, std::FILE* stream) {
  if (text.empty() || !is_coloured(stream)) return text;
  return "\033[" + std::string(code) + "m" + text + "\033[0m";
}

}  // namespace

bool is_coloured(std::FILE* stream) {
  return isatty(fileno(stream)) != 0 && value_of("NO_COLOR").empty() && !value_of("TERM").empty() &&
         value_of("TERM") != "dumb";
}

std::string bold(const std::string& text, std::FILE* stream) { return in_colour("1", text, stream); }
std::string red(const std::string& text, std::FILE* stream) { return in_colour("1;31", text, stream); }
std::string yellow(const std::string& text, std::FILE* stream) { return in_colour("33", text, stream); }

}  // namespace ballbar

#include "terminal/stderr_line.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "terminal/caller.hpp"

namespace ballbar {
namespace {

std::string value_of(const char* variable) {
  const char* const value = std::getenv(variable);
  return value == nullptr ? "" : value;
}

bool is_coloured(std::FILE* stream) {
  return isatty(fileno(stream)) != 0 && value_of("NO_COLOR").empty() && !value_of("TERM").empty() &&
         value_of("TERM") != "dumb";
}

std::string in_colour(std::string_view code, const std::string& text, std::FILE* stream) {
  if (text.empty() || !is_coloured(stream)) return text;
  return "\033[" + std::string(code) + "m" + text + "\033[0m";
}

}  // namespace

std::string bold(const std::string& text) { return in_colour("1", text, stdout); }

void stderr_line(const std::string& text) {
  if (const Caller* program = caller(); program != nullptr && program->remark) return program->remark(text);
  std::fputs((text + "\n").c_str(), stderr);
}

void wrote_line(const std::string& file) {
  if (const Caller* program = caller(); program != nullptr && program->wrote) return program->wrote(file);
  stderr_line("wrote " + file);
}

void tell(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) stderr_line("ballbar: " + remark);
}

void error_line(const std::string& text) { stderr_line(in_colour("1;31", "ballbar:", stderr) + " " + text); }

void warning_line(const std::string& text) { stderr_line(caller() == nullptr ? in_colour("33", text, stderr) : text); }

bool progress_is_taken() { return caller() != nullptr && caller()->progress; }

void show_progress(std::string_view line) {
  if (progress_is_taken()) return caller()->progress(line);
  if (isatty(STDERR_FILENO) == 0) return;
  const std::string text = "\r\033[K" + std::string(line);
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace ballbar

#include "terminal/stderr_line.hpp"

#include <cstdio>

#include "terminal/caller.hpp"
#include "terminal/colour.hpp"

namespace ballbar {

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

void error_line(const std::string& text) { stderr_line(red("ballbar:") + " " + text); }

void warning_line(const std::string& text) { stderr_line(caller() == nullptr ? yellow(text) : text); }

}  // namespace ballbar

#include "terminal/stderr_line.hpp"

#include <cstdio>

namespace ballbar {

void stderr_line(const std::string& text) { std::fputs((text + "\n").c_str(), stderr); }

void tell(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) stderr_line("ballbar: " + remark);
}

}  // namespace ballbar

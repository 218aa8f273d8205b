#include "terminal/output_guard.hpp"

#include <fmt/format.h>

#include "ballbar/error.hpp"

namespace ballbar {

void expect_no_input(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs,
                     std::string_view option) {
  for (const std::string& output : outputs) {
    for (const std::filesystem::path& input : inputs) {
      std::error_code absent;  // then it is not the same file
      if (!std::filesystem::equivalent(output, input, absent)) continue;
      throw Error(fmt::format("{} {}: expected another file than the inputs, found the input {}.", option, output,
                              input.string()));
    }
  }
}

}  // namespace ballbar

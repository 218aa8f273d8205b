#include "shell/renamed_options.hpp"

#include <fmt/format.h>

#include <string_view>

#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

struct Renamed {
  std::string_view command, before, now;
};

constexpr Renamed kRenamed[] = {
    {"compensate", "--replay", "--on"},             // as in predict: the data that it is tried on
    {"compensate", "--save", "--out"},              // told by its ending, .toml
    {"diagnose", "--tolerance-um", "--tolerance"},  // of a series and of circles alike
    {"history", "--csv", "--out"},
    {"history", "--page", "--out"},
    {"select", "--for", "--on"},
};

}  // namespace

std::vector<std::string> with_names_of_now(std::vector<std::string> words) {
  if (words.empty()) return words;
  for (std::size_t i = 1; i < words.size() && words[i] != "--"; ++i) {
    const std::size_t equals = words[i].find('=');
    for (const Renamed& one : kRenamed) {
      if (one.command != words.front() || one.before != words[i].substr(0, equals)) continue;
      warning_line(fmt::format("{} is called {} now; the old name goes with the next release", one.before, one.now));
      words[i] = std::string(one.now) + (equals == std::string::npos ? "" : words[i].substr(equals));
      break;
    }
  }
  return words;
}

}  // namespace ballbar

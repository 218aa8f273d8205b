#include "text/located_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kNone = std::string_view::npos;

// Offset of the first byte that is not UTF-8, or kNone. Eight ASCII bytes a step.
std::size_t first_not_utf8(std::string_view bytes) {
  std::size_t i = 0;
  while (i < bytes.size()) {
    std::uint64_t word = 0;
    if (i + sizeof word <= bytes.size()) {
      std::memcpy(&word, bytes.data() + i, sizeof word);
      if ((word & 0x8080808080808080u) == 0) {
        i += sizeof word;
        continue;
      }
    }
    const std::size_t length = utf8_length(bytes.substr(i, 4));
    if (length == 0) return i;
    i += length;
  }
  return kNone;
}

}  // namespace

SourceText source_text(std::string_view bytes, std::string_view name) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const SourceText text{bytes, name};
  if (bytes.empty()) throw Error(fmt::format("{}:1:1: expected text, found an empty file.", name));
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    throw Error(fmt::format("{}:1:1: expected UTF-8, found UTF-16; save the file as UTF-8.", name));
  }
  if (const std::size_t nul = bytes.find('\0'); nul != kNone) {
    fail_at(text, nul, "expected text, found a NUL byte; this is a binary file.");
  }
  if (const std::size_t bad = first_not_utf8(bytes); bad != kNone) {
    fail_at(text, bad,
            fmt::format("expected UTF-8, found the byte {}; save the file as UTF-8.", in_quotes(bytes.substr(bad, 1))));
  }
  return text;
}

void fail_at(const SourceText& text, std::size_t offset, std::string_view sentence) {
  const std::string_view before = text.bytes.substr(0, offset);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::string_view in_line = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto column = std::count_if(in_line.begin(), in_line.end(),
                                    [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }) +
                      1;
  throw Error(fmt::format("{}:{}:{}: {}", text.name, line, column, sentence));
}

}  // namespace ballbar

#include "text/located_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kNone = std::string_view::npos;

}  // namespace

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

bool is_utf16(std::string_view bytes) { return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"); }

void append_utf8(std::string& to, std::uint32_t point) {
  const auto tail = [&](int shift) { to += static_cast<char>(0x80u | ((point >> shift) & 0x3Fu)); };
  if (point < 0x80) {
    to += static_cast<char>(point);
  } else if (point < 0x800) {
    to += static_cast<char>(0xC0u | (point >> 6));
    tail(0);
  } else if (point < 0x10000) {
    to += static_cast<char>(0xE0u | (point >> 12));
    tail(6);
    tail(0);
  } else {
    to += static_cast<char>(0xF0u | (point >> 18));
    tail(12);
    tail(6);
    tail(0);
  }
}

std::string utf8_from_utf16(std::string_view bytes) {
  constexpr std::uint32_t kReplacement = 0xFFFD;
  const std::size_t high = bytes.front() == '\xFE' ? 0 : 1;
  const auto unit = [&](std::size_t at) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + high]) * 256 +
                                      static_cast<unsigned char>(bytes[at + 1 - high]));
  };
  const auto is_low = [](std::uint32_t value) { return value >= 0xDC00 && value < 0xE000; };
  std::string utf8;
  utf8.reserve(bytes.size() / 2);
  std::size_t at = 2;
  for (; at + 1 < bytes.size(); at += 2) {
    const std::uint32_t first = unit(at);
    if (first < 0xD800 || first >= 0xE000) {
      append_utf8(utf8, first);
    } else if (!is_low(first) && at + 3 < bytes.size() && is_low(unit(at + 2))) {
      append_utf8(utf8, 0x10000 + ((first - 0xD800) << 10) + (unit(at + 2) - 0xDC00));
      at += 2;
    } else {
      append_utf8(utf8, kReplacement);
    }
  }
  if (at < bytes.size()) append_utf8(utf8, kReplacement);
  return utf8;
}

SourceText source_text(std::string_view bytes, std::string_view name) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const SourceText text{bytes, name};
  if (bytes.empty()) throw Error(fmt::format("{}:1:1: expected text, found an empty file.", name));
  if (is_utf16(bytes)) {
    throw Error(fmt::format("{}:1:1: expected UTF-8, found UTF-16. Save the file as UTF-8.", name));
  }
  if (const std::size_t nul = bytes.find('\0'); nul != kNone) {
    fail_at(text, nul, "expected text, found a NUL byte; this is a binary file.");
  }
  if (const std::size_t bad = first_not_utf8(bytes); bad != kNone) {
    fail_at(text, bad,
            fmt::format("expected UTF-8, found the byte {}. Save the file as UTF-8.", in_quotes(bytes.substr(bad, 1))));
  }
  return text;
}

std::string located(const SourceText& text, std::size_t offset, std::string_view sentence) {
  const std::string_view before = text.bytes.substr(0, offset);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::string_view in_line = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto column = std::count_if(in_line.begin(), in_line.end(),
                                    [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }) +
                      1;
  return fmt::format("{}:{}:{}: {}", text.name, line, column, sentence);
}

void fail_at(const SourceText& text, std::size_t offset, std::string_view sentence) {
  throw Error(located(text, offset, sentence));
}

}  // namespace ballbar

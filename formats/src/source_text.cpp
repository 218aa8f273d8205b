#include "source_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kNone = std::string_view::npos;

// Length of the UTF-8 sequence at `bytes`, 0 if it is not one (overlong, surrogate, past U+10FFFF, cut off).
std::size_t utf8_length(std::string_view bytes) {
  const auto at = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  const auto continues = [&](std::size_t i) { return (at(i) & 0xC0u) == 0x80u; };
  const unsigned lead = at(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return continues(1) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF) {
    const bool fits = (lead != 0xE0 || at(1) >= 0xA0) && (lead != 0xED || at(1) <= 0x9F);
    return fits && continues(1) && continues(2) ? 3 : 0;
  }
  if (lead >= 0xF0 && lead <= 0xF4) {
    const bool fits = (lead != 0xF0 || at(1) >= 0x90) && (lead != 0xF4 || at(1) <= 0x8F);
    return fits && continues(1) && continues(2) && continues(3) ? 4 : 0;
  }
  return 0;
}

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

std::string in_quotes(std::string_view found) {
  constexpr std::size_t kLongest = 40;
  std::string result = "\"";
  std::size_t i = 0;
  while (i < found.size() && i < kLongest) {
    const std::size_t length = utf8_length(found.substr(i, 4));
    const auto byte = static_cast<unsigned char>(found[i]);
    if (length == 0 || byte < 0x20 || byte == 0x7F) {
      result += fmt::format("\\x{:02X}", byte);
      ++i;
    } else {
      result += found.substr(i, length);
      i += length;
    }
  }
  return result + (i < found.size() ? "...\"" : "\"");
}

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known) {
  name = name.substr(0, 100);                          // what is longer is near to nothing
  const auto distance = [&](std::string_view other) {  // Levenshtein, one row
    std::vector<std::size_t> row(other.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < name.size(); ++i) {
      std::size_t diagonal = row[0]++;
      for (std::size_t j = 0; j < other.size(); ++j) {
        const std::size_t replaced = diagonal + (name[i] == other[j] ? 0 : 1);
        diagonal = row[j + 1];
        row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
      }
    }
    return row.back();
  };
  return *std::min_element(known.begin(), known.end(),
                           [&](auto left, auto right) { return distance(left) < distance(right); });
}

}  // namespace ballbar

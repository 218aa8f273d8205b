// Text of a file with places in it, for messages that say where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "ballbar/internal/nearest_name.hpp"  // in_quotes too

namespace ballbar {

struct SourceText {
  std::string_view bytes;  // UTF-8 without byte order mark
  std::string_view name;   // stands in messages
};

// UTF-16 with a byte order mark, which is what makes it that.
bool is_utf16(std::string_view bytes);

// Offset of the first byte that is not UTF-8, or npos. Eight ASCII bytes a step.
std::size_t first_not_utf8(std::string_view bytes);

// A code point as UTF-8.
void append_utf8(std::string& to, std::uint32_t point);

// UTF-8 of that, without byte order mark; of half a pair, or of an odd byte at the end, U+FFFD.
std::string utf8_from_utf16(std::string_view bytes);

// Strips the byte order mark. Throws Error: empty, a NUL (binary), UTF-16, not UTF-8.
SourceText source_text(std::string_view bytes, std::string_view name);

// "name:line:column: sentence". Columns count characters, not bytes.
std::string located(const SourceText& text, std::size_t offset, std::string_view sentence);

// Throws that as an Error.
[[noreturn]] void fail_at(const SourceText& text, std::size_t offset, std::string_view sentence);

}  // namespace ballbar

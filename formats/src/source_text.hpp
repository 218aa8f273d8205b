// Text of a file with places in it, for messages that say where.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace ballbar {

struct SourceText {
  std::string_view bytes;  // UTF-8 without byte order mark
  std::string_view name;   // stands in messages
};

// Strips the byte order mark. Throws Error: empty, a NUL (binary), UTF-16, not UTF-8.
SourceText source_text(std::string_view bytes, std::string_view name);

// Throws Error "name:line:column: sentence". Columns count characters, not bytes.
[[noreturn]] void fail_at(const SourceText& text, std::size_t offset, std::string_view sentence);

// What was found, in quotes, shortened, unprintable bytes as \xNN: for messages.
std::string in_quotes(std::string_view found);

// The known name with the fewest changed, missing or extra letters. `known` is not empty.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

}  // namespace ballbar

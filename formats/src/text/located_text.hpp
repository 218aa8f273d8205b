// Text of a file with places in it, for messages that say where.
#pragma once

#include <cstddef>
#include <string_view>

#include "ballbar/nearest_name.hpp"  // in_quotes too

namespace ballbar {

struct SourceText {
  std::string_view bytes;  // UTF-8 without byte order mark
  std::string_view name;   // stands in messages
};

// Strips the byte order mark. Throws Error: empty, a NUL (binary), UTF-16, not UTF-8.
SourceText source_text(std::string_view bytes, std::string_view name);

// Throws Error "name:line:column: sentence". Columns count characters, not bytes.
[[noreturn]] void fail_at(const SourceText& text, std::size_t offset, std::string_view sentence);

}  // namespace ballbar

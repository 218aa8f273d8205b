// Information from the head of a text file, for readers that recognise their format by it.
#pragma once

#include <string_view>

namespace ballbar {

// Without byte order mark and leading blanks; empty for bytes with a NUL, which are no text.
std::string_view text_of_head(std::string_view head);

bool has_nul(std::string_view head);

// "ballbar-log" of the first line `format = "ballbar-log 1"`, with or without `#`; empty where there is none.
std::string_view format_name(std::string_view head);

// From the first line without `#` on: of a table the names of its columns.
std::string_view after_comments(std::string_view head);

// An XML text's root element; empty for what is no XML, and where a document type or no element stands there.
std::string_view xml_root(std::string_view head);

}  // namespace ballbar

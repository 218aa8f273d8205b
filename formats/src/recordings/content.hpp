// What a file holds, told by its bytes, never by its name.
#pragma once

#include <string>
#include <string_view>

namespace ballbar {

enum class Content { empty, binary, xml, ballbar_log, series, session, model, table, unknown };

Content content_of(std::string_view bytes);

// For "found ...": "a .b5r file or other XML", "a series".
std::string_view description(Content content);

}  // namespace ballbar

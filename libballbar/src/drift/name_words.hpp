// Words in the names of columns.
#pragma once

#include <string_view>

namespace ballbar {

bool is_same_but_for_capitals(std::string_view a, std::string_view b);

// Whether letters and digits of the name in a row are that word, in capitals or not: "CH1_X1_um" has X1.
bool has_word(std::string_view name, std::string_view word);

}  // namespace ballbar

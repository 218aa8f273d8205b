// What a sentence says of a name that is not known.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ballbar {

// How many letters are changed, missing, extra or exchanged with the next (optimal string alignment).
std::size_t letters_apart(std::string_view name, std::string_view other);

// The known name with the fewest changed, missing, extra or exchanged letters. `known` is not empty.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

// The same where it is near: at most one letter in three is other, or `name` is its beginning. Empty where none is.
std::string_view near_name(std::string_view name, std::span<const std::string_view> known);

// What was found, in quotes, shortened, unprintable bytes as \xNN: for messages.
std::string in_quotes(std::string_view found);

// Length of the UTF-8 sequence at the start of `bytes`, 0 if it is not one (overlong, surrogate, past U+10FFFF, cut
// off).
std::size_t utf8_length(std::string_view bytes);

}  // namespace ballbar

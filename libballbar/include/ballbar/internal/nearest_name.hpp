// Suggestions and quotes for messages about unknown names.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ballbar {

// Number of changed, missing, extra or transposed letters (optimal string alignment distance).
std::size_t letters_apart(std::string_view name, std::string_view other);

// The known name with the smallest letters_apart(). `known` must not be empty.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

// The same, but only if it is near: at most one letter in three differs, or it begins with `name`. Else empty.
std::string_view near_name(std::string_view name, std::span<const std::string_view> known);

// The text in quotes for a message: shortened, with unprintable bytes as \xNN.
std::string in_quotes(std::string_view found);

// Length of the UTF-8 sequence at the start of `bytes`, 0 if it is not one (overlong, surrogate, past U+10FFFF, cut
// off).
std::size_t utf8_length(std::string_view bytes);

}  // namespace ballbar

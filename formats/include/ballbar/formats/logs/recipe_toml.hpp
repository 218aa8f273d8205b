// A recipe (.toml) states how to read a kind of log. `ballbar import LOG --save recipe.toml` writes one, `--recipe`
// applies it.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "ballbar/formats/logs/log.hpp"

namespace ballbar {

// Names of signs in a recipe and on the command line.
inline constexpr std::pair<std::string_view, char> kDelimiterNames[] = {
    {"comma", ','}, {"semicolon", ';'}, {"tab", '\t'}, {"bar", '|'}, {"blank", ' '}};
inline constexpr std::pair<std::string_view, char> kDecimalNames[] = {{"comma", ','}, {"point", '.'}};

// Throws Error with name:line:column.
LogRecipe read_recipe(std::string_view bytes, std::string_view name);
std::string write_recipe(const LogRecipe& recipe);

}  // namespace ballbar

// A recipe, .toml: how a kind of log is read. `ballbar import LOG --save recipe.toml` writes one, `--recipe` applies
// it.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/formats/logs/log.hpp"

namespace ballbar {

// Throws Error with name:line:column.
LogRecipe read_recipe(std::string_view bytes, std::string_view name);
std::string write_recipe(const LogRecipe& recipe);

}  // namespace ballbar

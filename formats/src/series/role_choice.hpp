// A role of a column as a key of a TOML table.
#pragma once

#include <optional>
#include <string_view>

#include "ballbar/series/series.hpp"
#include "text/toml_source.hpp"

namespace ballbar {

// Nullopt where the table lacks the key. Throws Error for what is no role.
std::optional<Role> role_choice(const TomlTable& table, std::string_view key);

}  // namespace ballbar

#include "series/role_choice.hpp"

#include <vector>

namespace ballbar {

std::optional<Role> role_choice(const TomlTable& table, std::string_view key) {
  constexpr int kRoles = static_cast<int>(Role::measured) + 1;
  std::vector<std::string_view> names;
  names.reserve(kRoles);
  for (int role = 0; role < kRoles; ++role) names.push_back(name_of(static_cast<Role>(role)));
  const std::optional<std::size_t> index = choice_index(table, key, names);
  return index ? std::optional(static_cast<Role>(*index)) : std::nullopt;
}

}  // namespace ballbar

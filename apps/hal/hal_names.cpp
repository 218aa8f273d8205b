#include "hal/hal_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "ballbar/error.hpp"

namespace ballbar::hal {
namespace {

constexpr std::size_t kLongest = 47;  // HAL_NAME_LEN

// std::isalnum would ask the locale.
bool fits(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
}

}  // namespace

std::vector<std::string> signal_pins(const std::string& component, std::span<const std::string> columns) {
  std::vector<std::string> pins;
  for (const std::string& column : columns) {
    std::string name = component + ".signal." + column;
    std::replace(name.begin(), name.end(), '_', '-');
    if (!std::all_of(name.begin(), name.end(), fits)) {
      throw Error(
          fmt::format("column '{}': expected letters, digits, '_', '-' and '.', of which a HAL name is made.", column));
    }
    if (name.size() > kLongest) {
      throw Error(fmt::format("column '{}': its pin '{}' has {} characters, HAL takes {}.", column, name, name.size(),
                              kLongest));
    }
    const auto same = std::find(pins.begin(), pins.end(), name);
    if (same != pins.end()) {
      throw Error(fmt::format("columns '{}' and '{}': both would be the pin '{}'.",
                              columns[static_cast<std::size_t>(same - pins.begin())], column, name));
    }
    pins.push_back(std::move(name));
  }
  return pins;
}

std::string letters_of(std::span<const CompensatedAxis> axes) {
  std::string letters;
  for (const CompensatedAxis& axis : axes) {
    if (axis.name.size() != 1 || std::string_view("xyzuvw").find(axis.name) == std::string_view::npos) {
      throw Error(
          fmt::format("--to: expected the letter of a linear axis, one of x y z u v w, found '{}': an offset is a "
                      "length, which the angles a b c cannot take.",
                      axis.name));
    }
    letters += axis.name;
  }
  return letters;
}

}  // namespace ballbar::hal

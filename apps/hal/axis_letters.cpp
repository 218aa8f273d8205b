#include "hal/axis_letters.hpp"

#include <fmt/format.h>

#include <string_view>

#include "ballbar/error.hpp"

namespace ballbar::hal {

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

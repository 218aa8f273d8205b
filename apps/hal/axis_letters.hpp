// The axes that can be given an offset: the linear ones of LinuxCNC, by their letter.
#pragma once

#include <span>
#include <string>

#include "ballbar/compensation/compensated_axes.hpp"

namespace ballbar::hal {

// The names of the axes, which are letters, in their order. Throws Error: another name than x y z u v w, for an offset
// is a length and a b c are angles.
std::string letters_of(std::span<const CompensatedAxis> axes);

}  // namespace ballbar::hal

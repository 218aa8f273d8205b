// How a camera was held, as it says so in the EXIF of a JPEG.
#pragma once

#include <string_view>

#include "ballbar/temperature/picture.hpp"

namespace ballbar {

// Of a JPEG's segment APP1: 1 to 8 by the EXIF specification, 4.6.4 (orientation); 1, as it is, for anything else.
int exif_orientation(std::string_view segment);

// As a viewer shows what is stored with that orientation.
Picture turned(Picture stored, int orientation);

}  // namespace ballbar

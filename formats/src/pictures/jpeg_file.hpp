// JPEG by libjpeg-turbo: what picture_file.hpp says of JPEG.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/temperature/picture.hpp"

namespace ballbar {

// Bytes that start as a JPEG and have its end, of a size that is known to be bearable. `name` stands in messages.
// Throws Error: damaged, colours of print (CMYK).
Picture decoded_jpeg(std::string_view bytes, std::string_view name);

// picture.rgb has 3 width height values; quality 1 to 100.
std::string encoded_jpeg(const Picture& picture, int quality);

}  // namespace ballbar

// PNG by libspng: what picture_file.hpp says of PNG.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/temperature/picture.hpp"

namespace ballbar {

// Bytes that start as a PNG, of a size that is known to be bearable. `name` stands in messages. Throws Error: damaged.
Picture decoded_png(std::string_view bytes, std::string_view name);

// picture.rgb has 3 width height values.
std::string encoded_png(const Picture& picture);

}  // namespace ballbar

// Pictures of temperature, PNG and JPEG, and the colour maps that such pictures are painted with.
//
// Coded by libspng and libjpeg-turbo, colour maps by OpenCV. This is a library of its own, ballbar::images, so that
// nothing else needs them; in a build without (BALLBAR_IMAGES=OFF) every function but picture_size throws an Error that
// says what to install, and there are no names of colour maps.
//
// A PNG's transparent pixels are laid over white, 16 bits a channel become 8, gray becomes red = green = blue. A JPEG
// is turned as its EXIF orientation says, so that pixels are where a viewer shows them. Colour profiles are ignored,
// and a JPEG in the colours of print, CMYK, is refused: without its profile nobody knows which colours are meant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/temperature/picture.hpp"

namespace ballbar {

inline constexpr std::size_t kLargestPicture = std::size_t{128} << 20;  // of a file: 128 MiB

struct PictureSize {
  std::size_t width = 0, height = 0;  // pixels, as stored
};

// What the header says; nothing is decoded. Throws Error: neither PNG nor JPEG, a header cut short, no pixels.
PictureSize picture_size(std::string_view bytes, std::string_view name);

// `name` stands in messages. Throws Error: as picture_size, more than 50 megapixels (before anything is decoded), a
// damaged file: a JPEG that ends early is refused, not filled up with gray.
Picture read_picture(std::string_view bytes, std::string_view name);

// The bytes of a file. quality of JPEG 1 to 100; 80 stores colour at half the resolution (4:2:0). Throws Error for a
// picture whose rgb has not 3 width height values, or none.
std::string write_png(const Picture& picture);
std::string write_jpeg(const Picture& picture, int quality);

// The 256 colours of a colour map of OpenCV, cold end first; with "_r" at its end the map's order is reversed, as
// "rainbow_r", for OpenCV's rainbow starts with red. Throws Error with the names for any other.
std::vector<Colour> colour_map(std::string_view name);
std::vector<std::string_view> colour_map_names();

}  // namespace ballbar

// Reads and writes pictures of temperature (PNG and JPEG), and provides the colour maps for them.
//
// It uses libspng, libjpeg-turbo and the colour maps of OpenCV. It is a library of its own, ballbar::images, so that
// nothing else depends on them. In a build without it (BALLBAR_IMAGES=OFF) every function but picture_size() throws an
// Error that states what to install, and there are no colour maps.
//
// Transparent pixels of a PNG are blended with white, 16 bits per channel become 8, gray becomes red = green = blue. A
// JPEG is rotated by its EXIF orientation, as viewers show it. Colour profiles are ignored. A JPEG in CMYK is refused,
// because its colours are not defined without a profile.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/temperature/temperature.hpp"

namespace ballbar {

inline constexpr std::size_t kLargestPicture = std::size_t{128} << 20;  // of a file: 128 MiB

struct PictureSize {
  std::size_t width = 0, height = 0;  // pixels, as stored
};

// The size from the header, without decoding. Throws Error: neither PNG nor JPEG, a truncated header, no pixels.
PictureSize picture_size(std::string_view bytes, std::string_view name);

// `name` is used in messages. Throws Error as picture_size() does, for more than 50 megapixels (before decoding), and
// for a damaged file. A truncated JPEG is refused, not filled with gray.
Picture read_picture(std::string_view bytes, std::string_view name);

// The bytes of a file. quality: 1 to 100; 80 stores colour at half the resolution (4:2:0). Throws Error for an empty
// picture, or one whose rgb does not have 3 width height values.
std::string write_png(const Picture& picture);
std::string write_jpeg(const Picture& picture, int quality);

// The 256 colours of a colour map of OpenCV, cold end first. The suffix "_r" reverses the map, as in "rainbow_r",
// because OpenCV's rainbow starts with red. Throws Error, with the known names, for any other name.
std::vector<Colour> colour_map(std::string_view name);
std::vector<std::string_view> colour_map_names();

}  // namespace ballbar

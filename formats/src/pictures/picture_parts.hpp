// Common parts of the readers and writers of pictures: the size of a file, its segments, PNG by libspng and JPEG by
// libjpeg-turbo.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ballbar/formats/pictures/picture_file.hpp"

namespace ballbar {

// Big-endian; `bytes` must reach to at + length.
std::size_t number_at(std::string_view bytes, std::size_t at, std::size_t length);

// The segments of a JPEG file, without decoding: a decoder does not look for the end once it has all pixels.
struct JpegOutline {
  std::optional<PictureSize> size;  // where there is a frame header
  bool whole = false;               // all segments, up to the marker EOI
};
JpegOutline jpeg_outline(std::string_view bytes);

// Throws Error. `what` may be empty; it stands without a full stop.
[[noreturn]] void fail_damaged(std::string_view name, std::string_view what);

// Bytes that start as a PNG, or as a JPEG and have its end, of a size that is known to be bearable. `name` stands in
// messages. Throws Error: damaged; of a JPEG colours of print (CMYK).
Picture decoded_png(std::string_view bytes, std::string_view name);
Picture decoded_jpeg(std::string_view bytes, std::string_view name);

// picture.rgb has 3 width height values; quality 1 to 100.
std::string encoded_png(const Picture& picture);
std::string encoded_jpeg(const Picture& picture, int quality);

// How a camera was held, as it says so in the EXIF of a JPEG, its segment APP1: 1 to 8 by the EXIF specification, 4.6.4
// (orientation); 1, as it is, for anything else.
int exif_orientation(std::string_view segment);

// As a viewer shows what is stored with that orientation.
Picture turned(Picture stored, int orientation);

}  // namespace ballbar

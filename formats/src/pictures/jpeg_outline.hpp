// The segments of a JPEG file, without decoding: its size, and whether it has its end. A decoder does not look for the
// end once it has all pixels.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "ballbar/formats/pictures/picture_file.hpp"

namespace ballbar {

// Big-endian; `bytes` must reach to at + length.
std::size_t number_at(std::string_view bytes, std::size_t at, std::size_t length);

struct JpegOutline {
  std::optional<PictureSize> size;  // where there is a frame header
  bool whole = false;               // all segments, up to the marker EOI
};
JpegOutline jpeg_outline(std::string_view bytes);

}  // namespace ballbar

// Size of a picture from its header, without a decoder: what a file may cost is known before it is decoded.
#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"
#include "pictures/picture_parts.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kEndOfImage = 0xFFD9, kStartOfScan = 0xFFDA;

bool is_frame_header(std::size_t marker) {
  return marker >= 0xFFC0 && marker <= 0xFFCF && marker != 0xFFC4 && marker != 0xFFC8 && marker != 0xFFCC;
}

// The next marker that ends the coded data of a scan: in it FF is followed by 00, or is a restart marker FFD0 to FFD7.
std::size_t scan_end(std::string_view bytes, std::size_t at) {
  while (at + 2 <= bytes.size()) {
    const std::size_t marker = number_at(bytes, at, 2);
    if (marker > 0xFF00 && marker < 0xFFFF && (marker < 0xFFD0 || marker > 0xFFD7)) return at;
    ++at;
  }
  return bytes.size();
}

constexpr std::string_view kPng = "\x89PNG\r\n\x1A\n";
constexpr std::string_view kJpeg = "\xFF\xD8\xFF";

// Signature, then the chunk IHDR: length, name, width, height (PNG specification, 11.2.2).
std::optional<PictureSize> png_size(std::string_view bytes) {
  if (bytes.size() < 33 || bytes.substr(12, 4) != "IHDR") return std::nullopt;
  return PictureSize{number_at(bytes, 16, 4), number_at(bytes, 20, 4)};
}

}  // namespace

std::size_t number_at(std::string_view bytes, std::size_t at, std::size_t length) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < length; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// ITU-T T.81, B.1 and B.2: FF, marker, length of the segment; the frame header holds precision, height, width.
JpegOutline jpeg_outline(std::string_view bytes) {
  JpegOutline outline;
  for (std::size_t at = 2; at + 2 <= bytes.size();) {
    const std::size_t marker = number_at(bytes, at, 2);
    if (marker == 0xFFFF) {  // fill before a marker
      ++at;
      continue;
    }
    outline.whole = marker == kEndOfImage && outline.size;
    if (marker < 0xFFC0 || marker == kEndOfImage || at + 9 > bytes.size()) break;
    if (is_frame_header(marker) && !outline.size) {
      outline.size = PictureSize{number_at(bytes, at + 7, 2), number_at(bytes, at + 5, 2)};
    }
    const std::size_t length = number_at(bytes, at + 2, 2);
    if (length < 2) break;
    at += 2 + length;
    if (marker == kStartOfScan) at = scan_end(bytes, at);
  }
  return outline;
}

PictureSize picture_size(std::string_view bytes, std::string_view name) {
  const bool png = bytes.starts_with(kPng);
  if (!png && !bytes.starts_with(kJpeg)) {
    throw Error(fmt::format("{}: expected a picture, PNG or JPEG, found {}.", name,
                            bytes.empty() ? "an empty file" : "a file that starts like neither"));
  }
  const std::optional<PictureSize> size = png ? png_size(bytes) : jpeg_outline(bytes).size;
  if (!size) {
    throw Error(fmt::format("{}: expected a whole {}, found one whose header is damaged or cut short.", name,
                            png ? "PNG" : "JPEG"));
  }
  if (size->width == 0 || size->height == 0) {
    throw Error(fmt::format("{}: expected a picture with pixels, found {} by {}.", name, size->width, size->height));
  }
  return *size;
}

}  // namespace ballbar

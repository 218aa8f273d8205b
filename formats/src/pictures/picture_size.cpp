// Size of a picture from its header, without a decoder: what a file may cost is known before it is decoded.
#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"
#include "pictures/jpeg_outline.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kPng = "\x89PNG\r\n\x1A\n";
constexpr std::string_view kJpeg = "\xFF\xD8\xFF";

// Signature, then the chunk IHDR: length, name, width, height (PNG specification, 11.2.2).
std::optional<PictureSize> png_size(std::string_view bytes) {
  if (bytes.size() < 33 || bytes.substr(12, 4) != "IHDR") return std::nullopt;
  return PictureSize{number_at(bytes, 16, 4), number_at(bytes, 20, 4)};
}

}  // namespace

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

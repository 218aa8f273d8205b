#include "ballbar/formats/pictures/picture_file.hpp"

#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "pictures/picture_parts.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostPixels = 50'000'000;

void expect_all_values(const Picture& picture) {
  if (picture.rgb.empty() || picture.rgb.size() != 3 * picture.width * picture.height) {
    throw Error(fmt::format("a picture of {} by {} pixels needs 3 values a pixel; found {}", picture.width,
                            picture.height, picture.rgb.size()));
  }
}

}  // namespace

void fail_damaged(std::string_view name, std::string_view what) {
  throw Error(
      fmt::format("{}: expected a whole picture, found a damaged one{}{}.", name, what.empty() ? "" : ": ", what));
}

Picture read_picture(std::string_view bytes, std::string_view name) {
  const PictureSize size = picture_size(bytes, name);
  if (size.width > kMostPixels / size.height) {
    throw Error(fmt::format("{}: expected at most {} megapixels, found {} by {}.", name, kMostPixels / 1'000'000,
                            size.width, size.height));
  }
  if (bytes.starts_with('\x89')) return decoded_png(bytes, name);
  if (!jpeg_outline(bytes).whole) fail_damaged(name, "it ends before its end marker");
  return decoded_jpeg(bytes, name);
}

std::string write_png(const Picture& picture) {
  expect_all_values(picture);
  return encoded_png(picture);
}

std::string write_jpeg(const Picture& picture, int quality) {
  expect_all_values(picture);
  return encoded_jpeg(picture, quality);
}

}  // namespace ballbar

#include <algorithm>
#include <cstddef>
#include <utility>

#include "pictures/picture_parts.hpp"

namespace ballbar {
namespace {

// A TIFF's numbers are in the order of its own first two letters.
struct Tiff {
  std::string_view bytes;
  bool little_endian = false;

  bool holds(std::size_t at, std::size_t length) const { return at <= bytes.size() && length <= bytes.size() - at; }
  // 0 where there is no such place.
  std::size_t number(std::size_t at, std::size_t length) const {
    std::size_t value = 0;
    for (std::size_t i = 0; holds(at, length) && i < length; ++i) {
      const std::size_t place = little_endian ? at + length - 1 - i : at + i;
      value = value << 8 | static_cast<unsigned char>(bytes[place]);
    }
    return value;
  }
};

}  // namespace

// "Exif", two zeros, a TIFF: byte order, 42, where its first directory is; that one's count of entries, 12 bytes each:
// tag, type, count, value.
int exif_orientation(std::string_view segment) {
  constexpr std::string_view kExif("Exif\0\0", 6);
  constexpr std::size_t kOrientation = 0x0112, kShort = 3, kEntry = 12;
  if (!segment.starts_with(kExif)) return 1;
  const std::string_view bytes = segment.substr(kExif.size());
  const Tiff tiff{bytes, bytes.starts_with("II")};
  if (!tiff.little_endian && !bytes.starts_with("MM")) return 1;
  const std::size_t directory = tiff.number(4, 4), count = tiff.number(directory, 2);
  for (std::size_t i = 0; i < count && tiff.holds(directory + 2 + i * kEntry, kEntry); ++i) {
    const std::size_t entry = directory + 2 + i * kEntry;
    if (tiff.number(entry, 2) != kOrientation || tiff.number(entry + 2, 2) != kShort) continue;
    const std::size_t value = tiff.number(entry + 8, 2);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

Picture turned(Picture stored, int orientation) {
  if (orientation <= 1 || orientation > 8) return stored;
  const bool lying = orientation >= 5;  // rows become columns
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  Picture shown{lying ? stored.height : stored.width, lying ? stored.width : stored.height, {}};
  shown.rgb.reserve(stored.rgb.size());
  for (std::size_t y = 0; y < shown.height; ++y) {
    for (std::size_t x = 0; x < shown.width; ++x) {
      const std::size_t column = lying ? y : x, row = lying ? x : y;
      const Colour colour = colour_at(stored, from_right ? stored.width - 1 - column : column,
                                      from_below ? stored.height - 1 - row : row);
      shown.rgb.insert(shown.rgb.end(), colour.begin(), colour.end());
    }
  }
  return shown;
}

}  // namespace ballbar

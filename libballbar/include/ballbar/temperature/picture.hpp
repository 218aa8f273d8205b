// A picture in memory: 8-bit red, green, blue, row by row from the top, as screens and files have it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ballbar {

using Colour = std::array<std::uint8_t, 3>;  // red, green, blue

struct Picture {
  std::size_t width = 0;          // pixels
  std::size_t height = 0;         // pixels
  std::vector<std::uint8_t> rgb;  // 3 width height values
};

// A rectangle of pixels: columns x to x + width - 1, rows y to y + height - 1, counted from the top left corner.
struct PixelBox {
  std::size_t x = 0, y = 0, width = 0, height = 0;
};

// The pixel in column x and row y; both must be in the picture.
inline Colour colour_at(const Picture& picture, std::size_t x, std::size_t y) {
  const std::size_t at = 3 * (y * picture.width + x);
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

}  // namespace ballbar

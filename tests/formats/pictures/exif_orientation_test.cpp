#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "pictures/picture_parts.hpp"

namespace ballbar {
namespace {

// A TIFF of one directory: entries as they stand, at offset 8.
std::string exif(const std::string& head, const std::string& entries) {
  return std::string("Exif\0\0", 6) + head + entries;
}

const std::string kBig("MM\0\x2A\0\0\0\x08", 8), kLittle("II\x2A\0\x08\0\0\0", 8);

// Tag 0x0112, type 3, one value.
std::string entry(char value) { return std::string("\x01\x12\0\x03\0\0\0\x01\0", 9) + value + std::string(2, '\0'); }

TEST(exif_orientation, in_both_byte_orders) {
  EXPECT_EQ(exif_orientation(exif(kBig, std::string("\0\x01", 2) + entry(6))), 6);
  EXPECT_EQ(exif_orientation(exif(kLittle, std::string("\x01\0\x12\x01\x03\0\x01\0\0\0\x08\0\0\0", 14))), 8);
  const std::string other("\x01\x1A\0\x05\0\0\0\x01\0\0\0\0", 12);
  EXPECT_EQ(exif_orientation(exif(kBig, std::string("\0\x02", 2) + other + entry(3))), 3);
}

TEST(exif_orientation, anything_else_is_as_it_is) {
  const std::string good = exif(kBig, std::string("\0\x01", 2) + entry(6));
  for (std::size_t length = 0; length < good.size() - 2; ++length) {
    EXPECT_EQ(exif_orientation(good.substr(0, length)), 1) << length;
  }
  EXPECT_EQ(exif_orientation(exif(kBig, std::string("\0\x01", 2) + entry(0))), 1);
  EXPECT_EQ(exif_orientation(exif(kBig, std::string("\0\x01", 2) + entry(9))), 1);
  EXPECT_EQ(exif_orientation(exif(std::string("XX\0\x2A\0\0\0\x08", 8), std::string("\0\x01", 2) + entry(6))), 1);
  EXPECT_EQ(exif_orientation(exif(std::string("MM\0\x2A\xFF\xFF\xFF\xFF", 8), std::string("\0\x01", 2) + entry(6))), 1);
  EXPECT_EQ(exif_orientation("http://ns.adobe.com/xap/1.0/"), 1);
}

// Stored as
//   1 2 3
//   4 5 6
// and shown as the EXIF specification says of where the stored first row and first column are: 1 top left, 2 top right,
// 3 bottom right, 4 bottom left, 5 left top, 6 right top, 7 right bottom, 8 left bottom.
TEST(exif_orientation, turns) {
  Picture stored{3, 2, {}};
  for (std::uint8_t value = 1; value <= 6; ++value) stored.rgb.insert(stored.rgb.end(), 3, value);
  const std::vector<std::pair<std::size_t, std::string>> shown = {{3, "123456"}, {3, "321654"}, {3, "654321"},
                                                                  {3, "456123"}, {2, "142536"}, {2, "415263"},
                                                                  {2, "635241"}, {2, "362514"}};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const auto& [width, values] = shown[static_cast<std::size_t>(orientation - 1)];
    const Picture picture = turned(stored, orientation);
    EXPECT_EQ(picture.width, width) << orientation;
    EXPECT_EQ(picture.height, 6 / width) << orientation;
    std::string found;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) found += static_cast<char>('0' + picture.rgb[i]);
    EXPECT_EQ(found, values) << orientation;
  }
}

}  // namespace
}  // namespace ballbar

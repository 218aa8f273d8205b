#include "ballbar/formats/pictures/picture_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

// Smooth, so that JPEG has little to lose.
Picture slope(std::size_t width, std::size_t height) {
  Picture picture{width, height, {}};
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      picture.rgb.push_back(static_cast<std::uint8_t>(100 + x));
      picture.rgb.push_back(static_cast<std::uint8_t>(100 + y));
      picture.rgb.push_back(90);
    }
  }
  return picture;
}

std::string message_of(std::string_view bytes) {
  testing::internal::CaptureStderr();
  std::string message = "read";
  try {
    read_picture(bytes, "file");
  } catch (const Error& error) {
    message = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  return message;
}

TEST(picture_file, png_comes_back_to_the_bit) {
  const Picture picture = slope(7, 5);
  const std::string png = write_png(picture);
  const PictureSize size = picture_size(png, "file");
  EXPECT_EQ(size.width, 7u);
  EXPECT_EQ(size.height, 5u);
  const Picture read = read_picture(png, "file");
  EXPECT_EQ(read.width, 7u);
  EXPECT_EQ(read.height, 5u);
  EXPECT_EQ(read.rgb, picture.rgb);
  EXPECT_EQ(colour_at(read, 6, 4), (Colour{106, 104, 90}));
}

TEST(picture_file, jpeg_comes_back_within_its_loss) {
  const Picture picture = slope(64, 48);
  const std::string jpeg = write_jpeg(picture, 95);
  const PictureSize size = picture_size(jpeg, "file");
  EXPECT_EQ(size.width, 64u);
  EXPECT_EQ(size.height, 48u);
  const Picture read = read_picture(jpeg, "file");
  ASSERT_EQ(read.rgb.size(), picture.rgb.size());
  int largest = 0;
  for (std::size_t i = 0; i < read.rgb.size(); ++i) largest = std::max(largest, std::abs(read.rgb[i] - picture.rgb[i]));
  EXPECT_LE(largest, 6);
  EXPECT_GT(largest, 0);
}

TEST(picture_file, jet_of_opencv_has_blue_first_and_red_last) {
  const auto jet = colour_map("jet");
  ASSERT_EQ(jet.size(), 256u);
  EXPECT_EQ(jet.front(), (Colour{0, 0, 128}));
  EXPECT_EQ(jet.back(), (Colour{128, 0, 0}));
  EXPECT_EQ(colour_map("jet_r").front(), jet.back());
  EXPECT_EQ(colour_map("gray")[77], (Colour{77, 77, 77}));
  for (const std::string_view name : colour_map_names()) EXPECT_EQ(colour_map(name).size(), 256u) << name;
}

TEST(picture_file, unknown_colour_map) {
  try {
    colour_map("jett");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "expected a colour map, one of bone, cividis, gray, hot, inferno, jet, magma, parula, plasma, "
                 "rainbow, turbo, viridis, or one of them with _r, found \"jett\".");
  }
}

TEST(picture_file, bad_bytes_and_what_is_said) {
  const std::string png = write_png(slope(40, 30)), jpeg = write_jpeg(slope(40, 30), 90);
  std::string vast = png;  // 20 000 by 3000 pixels, by its header
  vast.replace(16, 8, std::string("\0\0\x4E\x20\0\0\x0B\xB8", 8));
  std::string flat = png;
  flat.replace(20, 4, std::string(4, '\0'));
  std::string garbled = png;
  garbled.replace(garbled.size() / 2, 8, "ballbar!");
  const std::pair<std::string, std::string> table[] = {
      {"", "file: expected a picture, PNG or JPEG, found an empty file."},
      {"GIF89a", "file: expected a picture, PNG or JPEG, found a file that starts like neither."},
      {png.substr(0, 20), "file: expected a whole PNG, found one whose header is damaged or cut short."},
      {jpeg.substr(0, 20), "file: expected a whole JPEG, found one whose header is damaged or cut short."},
      {vast, "file: expected at most 50 megapixels, found 20000 by 3000."},
      {flat, "file: expected a picture with pixels, found 40 by 0."},
      {garbled, "file: expected a whole picture, found a damaged one: IDAT: incorrect data check."},
      {png.substr(0, png.size() / 2),
       "file: expected a whole picture, found a damaged one: PNG input buffer is incomplete."},
      {jpeg.substr(0, jpeg.size() - 40),
       "file: expected a whole picture, found a damaged one: it ends before its end marker."},
      {jpeg.substr(0, jpeg.size() - 2),
       "file: expected a whole picture, found a damaged one: it ends before its end marker."},
      {jpeg.substr(0, jpeg.size() - 40) + "\xFF\xD9",
       "file: expected a whole picture, found a damaged one: Corrupt JPEG data: premature end of data segment."},
  };
  for (const auto& [bytes, message] : table) EXPECT_EQ(message_of(bytes), message);
}

// 2 by 1 pixels, the second half opaque red: 255 over white stays, 128/255 red gives (255, 127, 127).
TEST(picture_file, opacity_is_over_white) {
  const std::uint8_t bgra[] = {0, 0, 255, 255, 0, 0, 255, 128};
  std::vector<std::uint8_t> png;
  cv::imencode(".png", cv::Mat(1, 2, CV_8UC4, const_cast<std::uint8_t*>(bgra)), png);
  const Picture read = read_picture(std::string(png.begin(), png.end()), "file");
  EXPECT_EQ(read.rgb, (std::vector<std::uint8_t>{255, 0, 0, 255, 127, 127}));
}

// 16 bits: 257 steps of 65535 are one of 255.
TEST(picture_file, sixteen_bits_of_gray) {
  const std::uint16_t gray[] = {0, 257, 25700, 65535};
  std::vector<std::uint8_t> png;
  cv::imencode(".png", cv::Mat(1, 4, CV_16UC1, const_cast<std::uint16_t*>(gray)), png);
  const Picture read = read_picture(std::string(png.begin(), png.end()), "file");
  EXPECT_EQ(read.rgb, (std::vector<std::uint8_t>{0, 0, 0, 1, 1, 1, 100, 100, 100, 255, 255, 255}));
}

TEST(picture_file, any_change_is_read_or_refused) {
  EXPECT_TRUE(rc::check([] {
    const bool png = *rc::gen::arbitrary<bool>();
    std::string bytes = png ? write_png(slope(20, 20)) : write_jpeg(slope(20, 20), 80);
    const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
    bytes[at] = *rc::gen::arbitrary<char>();
    if (*rc::gen::arbitrary<bool>()) bytes.resize(*rc::gen::inRange<std::size_t>(0, bytes.size()));
    try {
      const Picture read = read_picture(bytes, "file");
      RC_ASSERT(read.rgb.size() == 3 * read.width * read.height);
    } catch (const Error&) {
    }
  }));
}

TEST(picture_file, a_picture_without_all_its_values_is_not_written) {
  EXPECT_THROW(write_png({2, 2, {1, 2, 3}}), Error);
  EXPECT_THROW(write_jpeg({0, 0, {}}, 80), Error);
}

}  // namespace
}  // namespace ballbar

#include "ballbar/formats/pictures/picture_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

// After <cstdio>, whose names it uses.
#include <jpeglib.h>
#include <spng.h>

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

// A PNG of any kind: values as they stand, 16 bits in the machine's own order.
std::string png_of(spng_ihdr header, const void* values, std::size_t size, spng_trns* transparent = nullptr) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> png(spng_ctx_new(SPNG_CTX_ENCODER), &spng_ctx_free);
  EXPECT_EQ(spng_set_option(png.get(), SPNG_ENCODE_TO_BUFFER, 1), 0);
  EXPECT_EQ(spng_set_ihdr(png.get(), &header), 0);
  if (transparent != nullptr) {
    EXPECT_EQ(spng_set_trns(png.get(), transparent), 0);
  }
  EXPECT_EQ(spng_encode_image(png.get(), values, size, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), 0);
  int failed = 0;
  std::size_t length = 0;
  const std::unique_ptr<void, decltype(&std::free)> bytes(spng_get_png_buffer(png.get(), &length, &failed), &std::free);
  EXPECT_EQ(failed, 0);
  return {static_cast<const char*>(bytes.get()), length};
}

spng_ihdr header_of(std::uint32_t width, std::uint32_t height, std::uint8_t depth, spng_color_type type) {
  spng_ihdr header{};
  header.width = width;
  header.height = height;
  header.bit_depth = depth;
  header.color_type = static_cast<std::uint8_t>(type);
  return header;
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
  garbled.replace(garbled.size() - 16, 4, "ball");  // the checksum before the last chunk
  const std::pair<std::string, std::string> table[] = {
      {"", "file: expected a picture, PNG or JPEG, found an empty file."},
      {"GIF89a", "file: expected a picture, PNG or JPEG, found a file that starts like neither."},
      {png.substr(0, 20), "file: expected a whole PNG, found one whose header is damaged or cut short."},
      {jpeg.substr(0, 20), "file: expected a whole JPEG, found one whose header is damaged or cut short."},
      {vast, "file: expected at most 50 megapixels, found 20000 by 3000."},
      {flat, "file: expected a picture with pixels, found 40 by 0."},
      {garbled, "file: expected a whole picture, found a damaged one: invalid chunk checksum."},
      {png.substr(0, png.size() / 2), "file: expected a whole picture, found a damaged one: it ends early."},
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
  const std::uint8_t rgba[] = {255, 0, 0, 255, 255, 0, 0, 128};
  const Picture read = read_picture(png_of(header_of(2, 1, 8, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA), rgba, 8), "file");
  EXPECT_EQ(read.rgb, (std::vector<std::uint8_t>{255, 0, 0, 255, 127, 127}));
}

// One gray or one colour may be said to be transparent.
TEST(picture_file, a_transparent_colour_is_white) {
  spng_trns transparent{};
  transparent.gray = 7;
  const std::uint8_t gray[] = {6, 7};
  const std::string png = png_of(header_of(2, 1, 8, SPNG_COLOR_TYPE_GRAYSCALE), gray, 2, &transparent);
  EXPECT_EQ(read_picture(png, "file").rgb, (std::vector<std::uint8_t>{6, 6, 6, 255, 255, 255}));
}

// 16 bits: 257 steps of 65535 are one of 255.
TEST(picture_file, sixteen_bits_of_gray) {
  const std::uint16_t gray[] = {0, 257, 25700, 65535, 128, 129};
  const Picture read = read_picture(png_of(header_of(6, 1, 16, SPNG_COLOR_TYPE_GRAYSCALE), gray, 12), "file");
  EXPECT_EQ(read.rgb, (std::vector<std::uint8_t>{0, 0, 0, 1, 1, 1, 100, 100, 100, 255, 255, 255, 0, 0, 0, 1, 1, 1}));
}

// Text, profiles and the like: whatever is wrong with them, the pixels are there. Here: no text that could be unpacked,
// no such checksum, and more of them than the library takes.
TEST(picture_file, what_says_nothing_of_the_pixels_is_passed_over) {
  const Picture picture = slope(7, 5);
  std::string png = write_png(picture);
  for (int i = 0; i < 1001; ++i) png.insert(33, std::string("\0\0\0\x04zTXt\xFF\0\0\0????", 16));
  EXPECT_EQ(read_picture(png, "file").rgb, picture.rgb);
  png[33 + 4] = 'T';  // a name in upper case: needed for the pixels
  EXPECT_EQ(message_of(png), "file: expected a whole picture, found a damaged one: unknown critical chunk.");
}

// EXIF, "II", orientation 6: the stored left edge is the shown top.
TEST(picture_file, jpeg_is_turned_as_its_exif_says) {
  std::string jpeg = write_jpeg(slope(64, 48), 95);
  jpeg.insert(2, std::string("\xFF\xE1\0\x22"
                             "Exif\0\0II\x2A\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0",
                             36));
  const Picture read = read_picture(jpeg, "file");
  EXPECT_EQ(read.width, 48u);
  EXPECT_EQ(read.height, 64u);
  const Colour top_left = colour_at(read, 0, 0), bottom_right = colour_at(read, 47, 63);
  EXPECT_NEAR(top_left[0], 100, 6);
  EXPECT_NEAR(top_left[1], 147, 6);
  EXPECT_NEAR(bottom_right[0], 163, 6);
  EXPECT_NEAR(bottom_right[1], 100, 6);
  EXPECT_EQ(picture_size(jpeg, "file").width, 64u);
}

std::string jpeg_of(J_COLOR_SPACE space, int components) {
  jpeg_error_mgr errors{};
  jpeg_compress_struct jpeg{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = jpeg.image_height = 8;
  jpeg.input_components = components;
  jpeg.in_color_space = space;
  jpeg_set_defaults(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> values(static_cast<std::size_t>(8 * components), 200);
  for (JSAMPROW row = values.data(); jpeg.next_scanline < 8;) jpeg_write_scanlines(&jpeg, &row, 1);
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owned(bytes, &std::free);
  return {reinterpret_cast<const char*>(bytes), size};
}

TEST(picture_file, jpeg_of_gray_and_of_print) {
  EXPECT_EQ(read_picture(jpeg_of(JCS_GRAYSCALE, 1), "file").rgb, std::vector<std::uint8_t>(3 * 8 * 8, 200));
  EXPECT_EQ(message_of(jpeg_of(JCS_CMYK, 4)),
            "file: expected a JPEG in colours of a screen, found one in colours of print (CMYK).");
}

// The library warns of a JFIF of a version that it does not know, and that is all.
TEST(picture_file, a_warning_that_is_not_of_the_pixels) {
  const std::string jpeg = write_jpeg(slope(40, 30), 90);
  std::string next_jfif = jpeg;
  next_jfif[next_jfif.find("JFIF") + 5] = 3;
  EXPECT_EQ(message_of(next_jfif), "read");
  EXPECT_EQ(read_picture(next_jfif, "file").rgb, read_picture(jpeg, "file").rgb);
}

// Behind a frame header that asks for progressive scans, each a pass over all pixels and a few bytes long.
TEST(picture_file, more_scans_than_any_picture_has) {
  const std::string head("\xFF\xD8\xFF\xC2\0\x0B\x08\0\x10\0\x10\x01\x01\x11\0", 15);
  const std::string table = std::string("\xFF\xDB\0\x43\0", 5) + std::string(64, '\1');
  const std::string codes = std::string("\xFF\xC4\0\x14\0\x01", 6) + std::string(15, '\0') + '\0';
  const std::string scan("\xFF\xDA\0\x08\x01\x01\0\0\0\0\x0F", 11);  // the last: a bit a block
  std::string jpeg = head + table + codes;
  for (int i = 0; i < 101; ++i) jpeg += scan;
  EXPECT_EQ(message_of(jpeg + "\xFF\xD9"), "file: expected a whole picture, found a damaged one: more than 100 scans.");
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
  try {
    write_jpeg({65501, 1, std::vector<std::uint8_t>(3 * 65501)}, 80);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a JPEG: expected at most 65500 pixels a side, found 65501 by 1.");
  }
}

}  // namespace
}  // namespace ballbar

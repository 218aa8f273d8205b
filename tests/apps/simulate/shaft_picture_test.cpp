#include "simulate/shaft_picture.hpp"

#include <gtest/gtest.h>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"

namespace ballbar {
namespace {

// 20 degC at the rear end, 46 degC at the ball: 0.05 K/mm.
const TemperatureProfile kLine{{0.0, 520.0}, {20.0, 46.0}};

ShaftPictureStyle front_part() {
  ShaftPictureStyle style;
  style.colours = "gray";
  style.legend = false;
  style.from_mm = 190.0;
  style.to_mm = 520.0;
  return style;
}

Colour gray(int level) {
  const auto value = static_cast<std::uint8_t>(level);
  return {value, value, value};
}

// 640 by 180 pixels leave 616 by 132 to the shaft: 330 mm in 616 columns, 1.8667 px/mm, and 59.7, so 60 rows either
// side of the middle for a radius of 32 mm. In the middle of column 0 x = 190 + 0.5 * 330 / 616 = 190.268 mm and T
// = 29.513 degC; the scale is 29.5 and 46 rounded outwards, 29 to 46; 255 * 0.513 / 17 = 7.7. In the last column,
// 519.732 mm, 45.987 degC: 254.8.
TEST(shaft_picture, field_in_its_place) {
  const ShaftPicture painted = shaft_picture({}, kLine, front_part());
  const Picture& picture = painted.picture;
  EXPECT_EQ(picture.width, 640u);
  EXPECT_EQ(picture.height, 180u);
  ASSERT_EQ(picture.rgb.size(), 3u * 640u * 180u);
  EXPECT_EQ(painted.min_degC, 29.0);
  EXPECT_EQ(painted.max_degC, 46.0);
  EXPECT_FALSE(painted.bar.has_value());
  EXPECT_EQ(painted.shaft.x, 12u);
  EXPECT_EQ(painted.shaft.width, 616u);
  EXPECT_EQ(painted.shaft.y, 42u);  // 24 of text, 12 of margin, (132 - 120) / 2
  EXPECT_EQ(painted.shaft.height, 120u);
  EXPECT_EQ(colour_at(picture, 12, 42), gray(8));
  EXPECT_EQ(colour_at(picture, 12, 161), gray(8));
  EXPECT_EQ(colour_at(picture, 627, 102), gray(255));
}

// The nose, 420 mm, is 230 / 330 * 616 = 429.3 columns from the left: column 428 is the last of the shaft, 429 the
// first of the tool, whose 16 mm are 30 rows either side of row 102.
TEST(shaft_picture, outline_around_the_silhouette) {
  const Picture picture = shaft_picture({}, kLine, front_part()).picture;
  const Colour black = gray(0), white = gray(255);
  for (const std::size_t y : {41u, 42u, 100u, 161u}) EXPECT_EQ(colour_at(picture, 11, y) == black, y != 41u) << y;
  EXPECT_EQ(colour_at(picture, 10, 100), white);
  EXPECT_EQ(colour_at(picture, 12, 41), black);
  EXPECT_EQ(colour_at(picture, 12, 40), white);
  EXPECT_EQ(colour_at(picture, 12, 162), black);
  EXPECT_NE(colour_at(picture, 12 + 428, 42), black);
  EXPECT_NE(colour_at(picture, 12 + 428, 42), white);
  for (const std::size_t y : {42u, 71u, 132u, 161u}) EXPECT_EQ(colour_at(picture, 12 + 429, y), black) << y;
  EXPECT_EQ(colour_at(picture, 12 + 429, 41), white);
  EXPECT_NE(colour_at(picture, 12 + 429, 72), black);
  EXPECT_EQ(colour_at(picture, 12 + 430, 71), black);
  EXPECT_EQ(colour_at(picture, 12 + 430, 70), white);
  EXPECT_EQ(colour_at(picture, 12 + 616, 102), black);
  EXPECT_EQ(colour_at(picture, 12 + 617, 102), white);
}

// A tool of 40 mm radius decides: 132 / 80 = 1.65 px/mm, 66 rows either side of the middle, 544.5 columns; the shaft
// has 32 / 40 of that, 53.
TEST(shaft_picture, tool_thicker_than_the_shaft) {
  FiniteVolumeSpindle thick;
  thick.tool_radius_mm = 40.0;
  const ShaftPicture painted = shaft_picture(thick, kLine, front_part());
  EXPECT_EQ(painted.shaft.height, 132u);
  EXPECT_EQ(painted.shaft.width, 545u);
  EXPECT_EQ(painted.shaft.y, 36u);
  EXPECT_EQ(colour_at(painted.picture, painted.shaft.x, 102 - 54), gray(0));
  EXPECT_EQ(colour_at(painted.picture, painted.shaft.x, 102 - 55), gray(255));
  EXPECT_EQ(colour_at(painted.picture, painted.shaft.x + 500, 36 - 1), gray(0));
  EXPECT_EQ(colour_at(painted.picture, painted.shaft.x + 500, 36 - 2), gray(255));
}

// The bar: 16 columns, 12 of margin and 56 for the numbers to its right; rows 36 to 167. The middle of its first row is
// at 1 - 0.5 / 132 of the scale: 254.03; of its last at 0.97.
TEST(shaft_picture, legend) {
  ShaftPictureStyle style = front_part();
  style.legend = true;
  const ShaftPicture painted = shaft_picture({}, kLine, style);
  ASSERT_TRUE(painted.bar.has_value());
  EXPECT_EQ(painted.bar->x, 556u);
  EXPECT_EQ(painted.bar->y, 36u);
  EXPECT_EQ(painted.bar->width, 16u);
  EXPECT_EQ(painted.bar->height, 132u);
  EXPECT_EQ(colour_at(painted.picture, 556, 36), gray(254));
  EXPECT_EQ(colour_at(painted.picture, 571, 167), gray(1));
  EXPECT_EQ(colour_at(painted.picture, 572, 100), gray(0));
  EXPECT_LE(painted.shaft.x + painted.shaft.width, 544u);
}

bool has_ink(const Picture& picture, const PixelBox& box) {
  for (std::size_t y = box.y; y < box.y + box.height; ++y) {
    for (std::size_t x = box.x; x < box.x + box.width; ++x) {
      if (colour_at(picture, x, y) != gray(255)) return true;
    }
  }
  return false;
}

TEST(shaft_picture, says_that_it_is_simulated) {
  ShaftPictureStyle style = front_part();
  const Picture plain = shaft_picture({}, kLine, style).picture;
  EXPECT_TRUE(has_ink(plain, {12, 4, 80, 20}));  // SIMULATED: nine letters of about 8 pixels
  EXPECT_FALSE(has_ink(plain, {120, 4, 500, 20}));
  style.text = "30 min";
  EXPECT_TRUE(has_ink(shaft_picture({}, kLine, style).picture, {100, 4, 60, 20}));
}

// Four steps of gray: 0, 85, 170, 255, each over a quarter of the scale.
TEST(shaft_picture, bands) {
  ShaftPictureStyle style = front_part();
  style.bands = 4;
  style.min_degC = 29.5;  // 190 mm
  style.max_degC = 46.0;  // 520 mm
  const Picture picture = shaft_picture({}, kLine, style).picture;
  EXPECT_EQ(colour_at(picture, 12 + 153, 102), gray(0));
  EXPECT_EQ(colour_at(picture, 12 + 154, 102), gray(85));
  EXPECT_EQ(colour_at(picture, 12 + 461, 102), gray(170));
  EXPECT_EQ(colour_at(picture, 12 + 462, 102), gray(255));
}

// A field of one temperature has a scale too; values beyond a stated scale have the colour of its end.
TEST(shaft_picture, scales) {
  const TemperatureProfile level{{0.0, 520.0}, {20.0, 20.0}};
  const ShaftPicture painted = shaft_picture({}, level, front_part());
  EXPECT_EQ(painted.min_degC, 20.0);
  EXPECT_EQ(painted.max_degC, 21.0);
  ShaftPictureStyle style = front_part();
  style.min_degC = 35.0;
  style.max_degC = 40.0;
  const Picture clamped = shaft_picture({}, kLine, style).picture;
  EXPECT_EQ(colour_at(clamped, 12, 102), gray(0));
  EXPECT_EQ(colour_at(clamped, 627, 102), gray(255));
}

std::string complaint(const ShaftPictureStyle& style) {
  try {
    shaft_picture({}, kLine, style);
  } catch (const Error& error) {
    return error.what();
  }
  return "painted";
}

TEST(shaft_picture, refuses) {
  ShaftPictureStyle style = front_part();
  style.to_mm = 521.0;
  EXPECT_EQ(complaint(style), "a picture of the shaft: expected a part within 0 to 520 mm, found 190 to 521 mm.");
  style.to_mm = 190.0;
  EXPECT_EQ(complaint(style), "a picture of the shaft: expected a part within 0 to 520 mm, found 190 to 190 mm.");
  style = front_part();
  style.width_px = 199;
  EXPECT_EQ(complaint(style), "a picture of the shaft: expected width_px from 200 to 4000, found 199.");
  style = front_part();
  style.height_px = 4001;
  EXPECT_EQ(complaint(style), "a picture of the shaft: expected height_px from 100 to 4000, found 4001.");
  style = front_part();
  style.bands = 1;
  EXPECT_EQ(complaint(style), "a picture of the shaft: expected bands from 2 to 64, found 1.");
  style = front_part();
  style.min_degC = 50.0;
  style.max_degC = 40.0;
  EXPECT_EQ(complaint(style), "a picture of the shaft: expected max_degC above min_degC, found 40 and 50.");
  style = front_part();
  style.from_mm = 519.0;  // 1 mm of radius 16 mm in 616 by 132 pixels: 4.1 px/mm
  style.height_px = 100;
  EXPECT_EQ(complaint(style),
            "a picture of the shaft: expected a part that is painted larger than 4 pixels, found 1 mm of radius 16 mm "
            "in 616 by 52 pixels.");
}

}  // namespace
}  // namespace ballbar

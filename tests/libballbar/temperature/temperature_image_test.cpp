#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/temperature/temperature.hpp"

namespace ballbar {
namespace {

Picture filled(std::size_t width, std::size_t height, const Colour& colour) {
  Picture picture{width, height, {}};
  for (std::size_t i = 0; i < width * height; ++i) picture.rgb.insert(picture.rgb.end(), colour.begin(), colour.end());
  return picture;
}

void paint(Picture& picture, std::size_t x, std::size_t y, const Colour& colour) {
  for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * (y * picture.width + x) + c] = colour[c];
}

// Blue over green to red: 0, 50 and 100 degC.
ColourScale three_colours() { return scale_of({{0, 0, 255}, {0, 255, 0}, {255, 0, 0}}, 0.0, 100.0); }

// Half way from blue to green is 25 degC, a quarter from green to red 62.5.
TEST(temperature_image, colours_between_those_of_the_scale) {
  Picture picture = filled(20, 20, {0, 128, 127});
  for (std::size_t y = 0; y < 20; ++y) {
    for (std::size_t x = 10; x < 20; ++x) paint(picture, x, y, {64, 191, 0});
  }
  ImageOptions options;
  options.edge_px = 0;
  const TemperatureImage image = temperature_image(picture, three_colours(), options);
  EXPECT_EQ(image.used + image.contrasting, 400u);
  EXPECT_NEAR(image.degC[0], 25.0, 0.15);  // a level of 255 is 0.2 degC
  EXPECT_NEAR(image.degC[19], 62.5, 0.15);
}

// A ramp on gray: 30 by 12 pixels in the middle of 50 by 40, their box found, 3 pixels of edge left out: 24 by 6 used.
// Gray (128, 128, 128) is at least 120 levels off this scale.
TEST(temperature_image, box_and_edges_are_found) {
  Picture picture = filled(50, 40, {128, 128, 128});
  for (std::size_t y = 14; y < 26; ++y) {
    for (std::size_t x = 10; x < 40; ++x) {
      const auto green = static_cast<std::uint8_t>(3 * x);
      paint(picture, x, y, {0, green, static_cast<std::uint8_t>(255 - green)});
    }
  }
  const ColourScale scale = three_colours();
  const TemperatureImage image = temperature_image(picture, scale, {});
  EXPECT_EQ(image.region.x, 10u);
  EXPECT_EQ(image.region.y, 14u);
  EXPECT_EQ(image.region.width, 30u);
  EXPECT_EQ(image.region.height, 12u);
  EXPECT_EQ(image.used, 24u * 6u);
  EXPECT_EQ(image.at_edges, 30u * 12u - 24u * 6u);
  EXPECT_EQ(image.off_scale, 0u);

  // Pixel x has 3 x / 255 * 50 degC; column i of 30 is x = 10 + i in the middle of [i, i + 1] mm. So at 0 mm
  // T = 3 * 9.5 / 255 * 50 = 5.588, at 30 mm 23.235, the mean 14.412 at 15 mm.
  const ImageProfile columns = image_profile(image, scale, 0.0, 30.0, false);
  EXPECT_EQ(columns.columns, 30u);
  EXPECT_EQ(columns.empty_columns, 6u);
  EXPECT_NEAR(columns.profile.degC.front(), 5.588, 0.01);
  EXPECT_NEAR(columns.profile.degC.back(), 23.235, 0.01);
  EXPECT_NEAR(mean_degC(columns.profile), 14.412, 0.01);
  const auto points = mean_points(columns.profile);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].x_mm, 15.0, 0.01);
  // No scatter: only the step of the scale, 50 degC / sqrt(12).
  EXPECT_NEAR(columns.sigma_mean_degC, 50.0 / std::sqrt(12.0), 1e-9);
}

// The same ramp down the picture, with --vertical.
TEST(temperature_image, vertical_is_the_picture_turned) {
  Picture across = filled(40, 16, {128, 128, 128}), down = filled(16, 40, {128, 128, 128});
  for (std::size_t i = 4; i < 36; ++i) {
    for (std::size_t j = 2; j < 14; ++j) {
      const auto green = static_cast<std::uint8_t>(40 + 4 * i + j);
      const Colour colour{0, green, static_cast<std::uint8_t>(255 - green)};
      paint(across, i, j, colour);
      paint(down, j, i, colour);
    }
  }
  const ColourScale scale = three_colours();
  const ImageProfile a = image_profile(temperature_image(across, scale, {}), scale, 0.0, 100.0, false);
  const ImageProfile b = image_profile(temperature_image(down, scale, {}), scale, 0.0, 100.0, true);
  EXPECT_EQ(a.profile.degC, b.profile.degC);
  EXPECT_EQ(a.profile.sigma_degC, b.profile.sigma_degC);
  EXPECT_GT(a.profile.sigma_degC[10], 0.0);
}

// Lines of a colour on the scale, one pixel wide, red across blue.
TEST(temperature_image, thin_lines_are_left_out) {
  Picture picture = filled(60, 40, {0, 0, 255});
  for (std::size_t x = 0; x < 60; ++x) paint(picture, x, 20, {255, 0, 0});
  const TemperatureImage image = temperature_image(picture, three_colours(), {});
  EXPECT_EQ(image.contrasting, 60u);
  EXPECT_EQ(image.at_edges, 360u);
  EXPECT_EQ(image.used, 60u * 33u);
}

// White paper is the hot end of a scale from black to white; a gray shaft on it of 100/255.
TEST(temperature_image, white_paper_is_not_the_hot_end) {
  Picture picture = filled(60, 40, {255, 255, 255});
  for (std::size_t y = 10; y < 30; ++y) {
    for (std::size_t x = 10; x < 50; ++x) paint(picture, x, y, {100, 100, 100});
  }
  const ColourScale gray = scale_of({{0, 0, 0}, {255, 255, 255}}, 0.0, 255.0);
  const TemperatureImage image = temperature_image(picture, gray, {});
  EXPECT_EQ(image.region.x, 10u);
  EXPECT_EQ(image.region.width, 40u);
  EXPECT_NEAR(mean_degC(image_profile(image, gray, 0.0, 1.0, false).profile), 100.0, 1e-9);
}

// 90 pixels high: three bands of 30, or every pixel another; the middle of the i-th line is (i + 0.5) / 90 of the span.
TEST(legend, bands_and_smooth) {
  Picture bands = filled(10, 90, {0, 0, 0}), smooth = bands;
  const Colour three[] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}};  // from the top: hot first
  for (std::size_t y = 0; y < 90; ++y) {
    for (std::size_t x = 0; x < 10; ++x) {
      paint(bands, x, y, three[y / 30]);
      paint(smooth, x, y, {static_cast<std::uint8_t>(255 - 2 * y), 0, static_cast<std::uint8_t>(2 * y)});
    }
  }
  const ColourScale three_bands = legend_scale(bands, {0, 0, 10, 90}, 10.0, 40.0);
  EXPECT_TRUE(three_bands.banded);
  EXPECT_EQ(three_bands.colours, (std::vector<Colour>{three[2], three[1], three[0]}));
  EXPECT_EQ(three_bands.degC, (std::vector<double>{15.0, 25.0, 35.0}));
  EXPECT_DOUBLE_EQ(three_bands.step_degC, 10.0);

  const ColourScale all = legend_scale(smooth, {0, 0, 10, 90}, 0.0, 90.0);
  EXPECT_FALSE(all.banded);
  ASSERT_EQ(all.colours.size(), 90u);
  EXPECT_EQ(all.colours[45], (Colour{255 - 2 * 44, 0, 2 * 44}));
  EXPECT_DOUBLE_EQ(all.degC[45], 45.5);
  EXPECT_EQ(all.colours[0], (Colour{255 - 2 * 87, 0, 2 * 87}));  // the third line's
  EXPECT_EQ(all.colours[1], all.colours[0]);
  EXPECT_EQ(all.colours[3], (Colour{255 - 2 * 86, 0, 2 * 86}));
}

// Three bands of 10 degC, each 20 pixels: the staircase is taken as straight between its steps at 20 and 40 pixels,
// where T is 20 and 30 degC, and on beyond them: T = 10 + x / 2 degC per pixel, mean 25 at 30 pixels.
TEST(temperature_image, staircase_of_bands_is_straightened) {
  const Colour three[] = {{0, 0, 255}, {0, 255, 0}, {255, 0, 0}};
  Picture picture = filled(60, 30, {0, 0, 0});
  for (std::size_t y = 0; y < 30; ++y) {
    for (std::size_t x = 0; x < 60; ++x) paint(picture, x, y, three[x / 20]);
  }
  ColourScale scale{{three[0], three[1], three[2]}, {15.0, 25.0, 35.0}, true, 10.0};
  ImageOptions options;
  options.edge_px = 0;
  options.region = PixelBox{0, 0, 60, 30};
  const ImageProfile columns = image_profile(temperature_image(picture, scale, options), scale, 0.0, 60.0, false);
  EXPECT_NEAR(temperature_at(columns.profile, 30.0), 25.0, 0.1);
  EXPECT_NEAR(temperature_at(columns.profile, 20.0), 20.0, 0.3);
  EXPECT_NEAR(temperature_at(columns.profile, 0.0), 10.0, 0.6);
  EXPECT_NEAR(temperature_at(columns.profile, 60.0), 40.0, 0.6);
}

TEST(temperature_image, what_cannot_be_and_what_is_said) {
  const Picture picture = filled(30, 20, {128, 128, 128});
  const auto said = [](auto&& work) -> std::string {
    try {
      work();
      return "nothing";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(said([&] { temperature_image(picture, three_colours(), {}); }),
            "the picture needs pixels whose colour is on the scale; found none but lines, edges and the legend");
  ImageOptions outside;
  outside.region = PixelBox{20, 0, 11, 5};
  EXPECT_EQ(said([&] { temperature_image(picture, three_colours(), outside); }),
            "the region needs to be in the picture of 30 by 20 pixels; found 20,0,11,5");
  EXPECT_EQ(said([&] {
              legend_scale(picture, {0, 0, 10, 30}, 0.0, 1.0);
            }),
            "the legend needs to be in the picture of 30 by 20 pixels; found 0,0,10,30");
  EXPECT_EQ(said([&] {
              legend_scale(picture, {0, 0, 7, 5}, 0.0, 1.0);
            }),
            "the legend needs at least 8 pixels of length; found 7");
  EXPECT_EQ(said([&] {
              legend_scale(picture, {0, 0, 30, 5}, 0.0, 1.0);
            }),
            "the legend needs colours that change along its longer side; found one colour");
  EXPECT_EQ(said([] {
              scale_of({{0, 0, 0}, {1, 1, 1}}, 5.0, 5.0);
            }),
            "the scale needs a largest temperature above its least, both within 1e+06 degC of 0; found 5 to 5 degC");
  EXPECT_EQ(
      said([&] {
        scale_of({{0, 0, 0}, {1, 1, 1}}, 0.0, 1e308);
      }),
      "the scale needs a largest temperature above its least, both within 1e+06 degC of 0; found 0 to 1e+308 degC");
  const Picture blue = filled(30, 20, {0, 0, 255});
  const TemperatureImage image = temperature_image(blue, three_colours(), {});
  EXPECT_EQ(said([&] { image_profile(image, three_colours(), 5.0, 5.0, false); }),
            "the region needs an end 0.1 mm or more above its start, both within 1e+06 mm of 0; found 5 to 5 mm");
  EXPECT_EQ(said([&] { image_profile(image, three_colours(), 0.0, 1e308, false); }),
            "the region needs an end 0.1 mm or more above its start, both within 1e+06 mm of 0; found 0 to 1e+308 mm");
  TemperatureImage narrow{{0, 0, 7, 5}, std::vector<double>(35, 20.0), 35, 0, 0, 0};
  EXPECT_EQ(said([&] { image_profile(narrow, three_colours(), 0.0, 5.0, false); }),
            "the region needs at least 8 columns with 3 pixels on the scale; found 7");
}

// A shaft of 40 by 20 pixels and, 20 pixels further, a legend of 10 by 20 with the scale's colours: their boxes, with
// the edge, are what was painted.
TEST(temperature_image, a_legend_that_was_not_stated_is_no_part_of_the_spindle) {
  Picture across = filled(100, 40, {128, 128, 128}), down = filled(40, 100, {128, 128, 128});
  for (std::size_t y = 10; y < 30; ++y) {
    for (std::size_t x = 10; x < 80; ++x) {
      if (x >= 50 && x < 70) continue;
      paint(across, x, y, {0, 255, 0});
      paint(down, y, x, {0, 255, 0});
    }
  }
  const auto said = [](const Picture& picture, const ImageOptions& options) -> std::string {
    try {
      const PixelBox box = temperature_image(picture, three_colours(), options).region;
      return fmt::format("{},{},{},{}", box.x, box.y, box.width, box.height);
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(said(across, {}),
            "expected one thing on the scale, found 2 apart from each other: 10,10,40,20 and 70,10,10,20; state which "
            "is the spindle with --region, or the legend with --legend");
  EXPECT_EQ(said(down, {}),
            "expected one thing on the scale, found 2 apart from each other: 10,10,20,40 and 10,70,20,10; state which "
            "is the spindle with --region, or the legend with --legend");
  ImageOptions options;
  options.legend = PixelBox{70, 10, 10, 20};
  EXPECT_EQ(said(across, options), "10,10,40,20");
  options = {};
  options.region = PixelBox{5, 5, 90, 30};
  EXPECT_EQ(said(across, options), "5,5,90,30");
}

// 40 columns of 12 pixels: 10 red, 20 half way from blue to green, 10 blue; the ends are counted.
TEST(temperature_image, pixels_at_the_ends_of_the_scale_are_counted) {
  Picture picture = filled(40, 12, {0, 128, 127});
  for (std::size_t y = 0; y < 12; ++y) {
    for (std::size_t x = 0; x < 10; ++x) paint(picture, x, y, {255, 0, 0});
    for (std::size_t x = 30; x < 40; ++x) paint(picture, x, y, {0, 0, 255});
  }
  ImageOptions options;
  options.edge_px = 0;
  const TemperatureImage image = temperature_image(picture, three_colours(), options);
  EXPECT_EQ(image.at_hot_end, 120u);
  EXPECT_EQ(image.at_cold_end, 120u);
  EXPECT_TRUE(image.saturated_hot && image.saturated_cold);
  ColourScale banded = three_colours();
  banded.banded = true;
  options.region = PixelBox{0, 0, 40, 12};  // half way is off a banded scale
  EXPECT_EQ(temperature_image(picture, banded, options).at_hot_end, 0u);
}

// A field whose own ends are those of the scale is not saturated: columns of T = 50 + 50 sin, flat at both ends. At
// least a hundredth of the scale from them there is acos(0.98) / pi = 6.4 % of the pixels each, 2.6 % in the next.
TEST(temperature_image, a_flat_end_of_the_field_is_not_an_end_of_the_scale) {
  const auto painted = [](double largest_degC) {
    Picture picture = filled(400, 8, {0, 0, 0});
    for (std::size_t x = 0; x < 400; ++x) {
      const double T =
          std::min(largest_degC, 50.0 + 50.0 * std::sin(2.0 * std::acos(-1.0) * static_cast<double>(x) / 400.0));
      const double green = T < 50.0 ? 5.1 * T : 5.1 * (100.0 - T);
      const auto g = static_cast<std::uint8_t>(green + 0.5);
      const auto rest = static_cast<std::uint8_t>(255 - g);
      for (std::size_t y = 0; y < 8; ++y) paint(picture, x, y, T < 50.0 ? Colour{0, g, rest} : Colour{rest, g, 0});
    }
    return picture;
  };
  ImageOptions options;
  options.edge_px = 0;
  const TemperatureImage whole = temperature_image(painted(100.0), three_colours(), options);
  EXPECT_NEAR(static_cast<double>(whole.at_hot_end), 0.064 * 3200, 40);
  EXPECT_NEAR(static_cast<double>(whole.at_cold_end), 0.064 * 3200, 40);
  EXPECT_FALSE(whole.saturated_hot);
  EXPECT_FALSE(whole.saturated_cold);
  // The same where the scale ends at 80 degC: acos(0.6) / pi = 29.5 % are there, 1.3 % in the next hundredth.
  const ColourScale short_scale{{{0, 0, 255}, {0, 255, 0}, {153, 102, 0}}, {0.0, 50.0, 80.0}, false, 40.0};
  const TemperatureImage cut = temperature_image(painted(80.0), short_scale, options);
  EXPECT_TRUE(cut.saturated_hot);
  EXPECT_FALSE(cut.saturated_cold);
}

// The lines at the end of a legend's scale have one colour: the nearest of them may be the first or the last.
TEST(temperature_image, ends_of_a_legend_are_several_lines) {
  const Colour blue{0, 0, 255}, red{255, 0, 0};
  const ColourScale scale = scale_of({blue, blue, {0, 255, 0}, red, red}, 0.0, 40.0);
  const TemperatureImage hot = temperature_image(filled(20, 20, red), scale, {});
  EXPECT_EQ(hot.at_hot_end, 400u);
  EXPECT_EQ(hot.at_cold_end, 0u);
  EXPECT_EQ(temperature_image(filled(20, 20, blue), scale, {}).at_cold_end, 400u);
}

// Eq. 22 to 28 on a picture of 4 levels, 10 pixels: levels 0, 1, 2, 3 with 4, 3, 1, 2 pixels; mG = (3 + 2 + 6) / 10
// = 1.1.
//   k = 0: P1 = 0.4, m1 = 0,     P2 = 0.6, m2 = 11/6:  s^2 = 0.4 * 1.1^2 + 0.6 (0.7333)^2       = 0.8067
//   k = 1: P1 = 0.7, m1 = 3/7,   P2 = 0.3, m2 = 8/3:   s^2 = 0.21 (8/3 - 3/7)^2 = 0.21 * 2.2381^2 = 1.0519
//   k = 2: P1 = 0.8, m1 = 5/8,   P2 = 0.2, m2 = 3:     s^2 = 0.16 * 2.375^2                      = 0.9025
TEST(otsu, four_levels_by_hand) {
  Histogram histogram{};
  histogram[0] = 4, histogram[1] = 3, histogram[2] = 1, histogram[3] = 2;
  EXPECT_EQ(otsu_threshold(histogram), 1);
}

TEST(otsu, of_one_level_or_none) {
  Histogram histogram{};
  EXPECT_EQ(otsu_threshold(histogram), 0);
  histogram[200] = 7;
  EXPECT_EQ(otsu_threshold(histogram), 0);
}

// Top 10 at level 100, then 1 each at 101 to 110: the longer side is the right one, to its end 111. Distance under the
// line from (111, 0) to (100, 10), that is 10 (111 - i) - 11 count: 10 * 10 - 11 = 89 at 101, less further out. The
// threshold is one level beyond 101 as seen from the end: 102.
TEST(triangle, by_hand) {
  Histogram histogram{};
  histogram[100] = 10;
  for (std::size_t i = 101; i <= 110; ++i) histogram[i] = 1;
  EXPECT_EQ(triangle_threshold(histogram), 102);
}

// 12 pixels: 3 red, 4 green, 5 blue. Red levels 0 (9 pixels) and 255 (3): Otsu 0, triangle: top at 0, end 255, the line
// far from the empty levels; farthest at level 1, so 2. Blue levels 0 (7) and 255 (5): Otsu 0, triangle 2. So red > 0
// is hot (3), blue <= 2 middle (4), the rest cold (5): mean = 0 + 60 (5 * 3 + 3 * 4 + 5) / (6 * 12) = 26.667.
TEST(three_areas, twelve_pixels_by_hand) {
  Picture picture = filled(12, 1, {0, 0, 255});
  for (std::size_t x = 0; x < 3; ++x) paint(picture, x, 0, {255, 0, 0});
  for (std::size_t x = 3; x < 7; ++x) paint(picture, x, 0, {0, 255, 0});
  const TemperatureImage image{{0, 0, 12, 1}, std::vector<double>(12, 30.0), 12, 0, 0, 0};
  const ThreeAreas areas = three_areas(picture, image, 0.0, 60.0, false);
  EXPECT_EQ(areas.red_otsu, 0);
  EXPECT_EQ(areas.red_triangle, 2);
  EXPECT_EQ(areas.blue_otsu, 0);
  EXPECT_EQ(areas.blue_triangle, 2);
  EXPECT_EQ(areas.hot, 3u);
  EXPECT_EQ(areas.middle, 4u);
  EXPECT_EQ(areas.cold, 5u);
  EXPECT_NEAR(areas.mean_degC, 60.0 * 32.0 / 72.0, 1e-12);
  EXPECT_NEAR(areas.otsu_mean_degC, areas.mean_degC, 1e-12);
}

// A stepped shaft, two columns: red over 3 pixels, blue over 1; not used: the rest. By length half is hot, half cold:
// 0 + 60 (5 * 1/2 + 1/2) / 6 = 30. By pixels it would be 60 (5 * 3 + 1) / 24 = 40. The same turned.
TEST(three_areas, a_thick_part_weighs_as_a_thin_one) {
  const Colour red{255, 0, 0}, blue{0, 0, 255};
  Picture across = filled(2, 3, red), down = filled(3, 2, red);
  paint(across, 1, 1, blue);
  paint(down, 1, 1, blue);
  const TemperatureImage of_across{{0, 0, 2, 3}, {50.0, NAN, 50.0, 10.0, 50.0, NAN}, 4, 2};
  const TemperatureImage of_down{{0, 0, 3, 2}, {50.0, 50.0, 50.0, NAN, 10.0, NAN}, 4, 2};
  for (const ThreeAreas& areas :
       {three_areas(across, of_across, 0.0, 60.0, false), three_areas(down, of_down, 0.0, 60.0, true)}) {
    EXPECT_EQ(areas.hot, 3u);
    EXPECT_EQ(areas.cold, 1u);
    EXPECT_DOUBLE_EQ(areas.hot_share, 0.5);
    EXPECT_DOUBLE_EQ(areas.middle_share, 0.0);
    EXPECT_DOUBLE_EQ(areas.cold_share, 0.5);
    EXPECT_NEAR(areas.mean_degC, 30.0, 1e-12);
    EXPECT_NEAR(areas.otsu_mean_degC, 30.0, 1e-12);
  }
}

}  // namespace
}  // namespace ballbar

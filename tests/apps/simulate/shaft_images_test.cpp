#include "simulate/shaft_images.hpp"

#include <gtest/gtest.h>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"

namespace ballbar {
namespace {

constexpr const char* kMachine = R"([spindle]
profile_min = [0, 2.5]
[[spindle.image]]
time_min = 2.5
file = "a.png"
colours = "gray"
legend = false
bands = 9
from_mm = 190
to_mm = 520
min_degC = 20
max_degC = 40.5
width_px = 400
height_px = 150
[[spindle.image]]
time_min = 0
file = "b.jpg"
quality = 100
)";

TEST(shaft_images, every_key) {
  const std::vector<ShaftImage> images = read_shaft_images(kMachine, "m.toml");
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[0].time_s, 150.0);
  EXPECT_EQ(images[0].file, "a.png");
  EXPECT_EQ(images[0].style.colours, "gray");
  EXPECT_FALSE(images[0].style.legend);
  EXPECT_EQ(images[0].style.bands, 9u);
  EXPECT_EQ(images[0].style.from_mm, 190.0);
  EXPECT_EQ(images[0].style.to_mm, 520.0);
  EXPECT_EQ(images[0].style.min_degC, 20.0);
  EXPECT_EQ(images[0].style.max_degC, 40.5);
  EXPECT_EQ(images[0].style.width_px, 400u);
  EXPECT_EQ(images[0].style.height_px, 150u);
  EXPECT_EQ(images[1].time_s, 0.0);
  EXPECT_EQ(images[1].quality, 100);
  EXPECT_EQ(images[1].style.colours, "jet");
  EXPECT_TRUE(images[1].style.legend);
  EXPECT_FALSE(images[1].style.from_mm.has_value());
  EXPECT_TRUE(read_shaft_images("format = \"ballbar-machine 1\"", "m.toml").empty());
}

struct Bad {
  const char* text;  // of an image at 30 min
  const char* message;
};

TEST(shaft_images, bad_text) {
  const Bad cases[] = {
      {"file = \"a.png\"\nquality = 0",
       "m.toml:6:11: expected an integer from 1 to 100 for quality, found the integer 0."},
      {"file = \"a.png\"\nquality = 101",
       "m.toml:6:11: expected an integer from 1 to 100 for quality, found the integer 101."},
      {"file = \"a.png\"\nbands = -1", "m.toml:6:9: expected a count not below 0 for bands, found the integer -1."},
      {"file = \"a.png\"\nlegend = 1", "m.toml:6:10: expected true or false for legend, found the integer 1."},
      {"file = \"a.png\"\ncolors = \"jet\"",
       "m.toml:6:1: expected one of the keys time_min, file, colours, quality, legend, bands, from_mm, to_mm, "
       "min_degC, "
       "max_degC, width_px, height_px in [[spindle.image]] 1, found \"colors\"; the nearest is colours."},
      {"", "m.toml:3:1: expected the key file in [[spindle.image]] 1, found none."},
      {"file = \"a.bmp\"",
       "m.toml:5:8: expected a plain name that ends in .png or .jpg for file, found the text \"a.bmp\"."},
      {"file = \".png\"",
       "m.toml:5:8: expected a plain name that ends in .png or .jpg for file, found the text \".png\"."},
      {"file = \"../a.png\"",
       "m.toml:5:8: expected a plain name that ends in .png or .jpg for file, found the text \"../a.png\"."},
      {"file = \"b/a.png\"",
       "m.toml:5:8: expected a plain name that ends in .png or .jpg for file, found the text \"b/a.png\"."},
      {"file = \"/a.png\"",
       "m.toml:5:8: expected a plain name that ends in .png or .jpg for file, found the text \"/a.png\"."},
      {"file = \"a.png\"\n[[spindle.image]]\ntime_min = 30\nfile = \"a.png\"",
       "m.toml:8:8: expected a name for each image for file, found the text \"a.png\"."},
      {"file = \"a.png\"\n[[spindle.image]]\ntime_min = 31\nfile = \"b.png\"",
       "m.toml:7:12: expected one of the times of profile_min for time_min, found the integer 31."},
      {"file = \"a.png\"\n[[spindle.image]]\nfile = \"b.png\"",
       "m.toml:6:1: expected the key time_min in [[spindle.image]] 2, found none."},
  };
  for (const Bad& bad : cases) {
    try {
      read_shaft_images(std::string("[spindle]\nprofile_min = [30]\n[[spindle.image]]\ntime_min = 30\n") + bad.text,
                        "m.toml");
      ADD_FAILURE() << "accepted: " << bad.text;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), bad.message);
    }
  }
}

VirtualSpindle short_run() {
  VirtualSpindle spindle;
  spindle.plan = {.time_s = {0.0, 60.0}, .speed_rpm = {12000.0, 0.0}, .end_s = 150.0};
  spindle.clock.profile_s = {0.0, 150.0};
  return spindle;
}

TEST(shaft_images, files_are_what_is_painted) {
  const VirtualSpindle spindle = short_run();
  const std::vector<ShaftProfile> profiles =
      run_of(spindle.body, spindle.plan, spindle.mechanisms, spindle.clock).profiles;
  const std::vector<ShaftImage> images = read_shaft_images(kMachine, "m.toml");
  const std::vector<SimulatedFile> files = shaft_image_files(images, spindle, profiles);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].name, "a.png");
  EXPECT_EQ(files[1].name, "b.jpg");
  ShaftPictureStyle style = images[0].style;
  style.text = "2.5 min  0 rpm  degC";
  EXPECT_EQ(read_picture(files[0].bytes, "a").rgb, shaft_picture(spindle.body, profiles[1].shaft, style).picture.rgb);
  EXPECT_EQ(picture_size(files[1].bytes, "b").width, 640u);
  EXPECT_TRUE(files[1].bytes.starts_with("\xff\xd8"));
}

TEST(shaft_images, complaints_name_the_file) {
  const VirtualSpindle spindle = short_run();
  std::vector<ShaftImage> images = read_shaft_images(kMachine, "m.toml");
  const auto complaint = [&](const std::vector<ShaftProfile>& profiles) -> std::string {
    try {
      shaft_image_files(images, spindle, profiles);
    } catch (const Error& error) {
      return error.what();
    }
    return "no complaint";
  };
  EXPECT_EQ(complaint({}), "a.png: expected a profile of the shaft at 150 s, found none.");
  images[0].style.to_mm = 600.0;
  EXPECT_EQ(complaint({{150.0, {{0.0, 520.0}, {20.0, 30.0}}}}),
            "a.png: a picture of the shaft: expected a part within 0 to 520 mm, found 190 to 600 mm.");
}

}  // namespace
}  // namespace ballbar

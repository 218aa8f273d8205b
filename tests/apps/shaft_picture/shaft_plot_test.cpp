#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "ballbar/error.hpp"
#include "page/page_assets.hpp"
#include "shaft_picture/shaft_picture.hpp"

namespace ballbar {
namespace {

// T falls from 40 to 20 over 10 mm: mean 30 at 5 mm.
ShaftState falling() {
  ShaftState state;
  state.name = "a";
  state.profile = {{0, 10}, {40, 20}, {}};
  state.mean_degC = 30.0;
  for (const MeanPoint& point : mean_points(state.profile)) state.places.push_back({point});
  return state;
}

TEST(shaft_plot, data_of_the_drawing_are_what_json_has_and_the_profile) {
  EXPECT_EQ(mean_point_part({falling()}, {}, as_it_is("why")).dump(),
            R"({"conclusion":"why","states":[{"name":"a","length_mm":10.0,"mean_degC":30.0,"sigma_mean_degC":0.0,)"
            R"("mean_points":[{"x_mm":5.0,"sigma_mm":0.0,"slope_degC_per_mm":-2.0,"sigma_slope_degC_per_mm":0.0,)"
            R"("misplaced_um_per_mm":0.0}],"x_mm":[0.0,10.0],"degC":[40.0,20.0]}]})");
  EXPECT_EQ(mean_point_part({falling(), falling()}, BestPoint{7.5, 0.0, {}}, {})["best"]["x_mm"], 7.5);
}

// With the page and without, as this program is built: the checks build it without.
TEST(shaft_plot, svg_needs_the_page_and_png_does_not) {
  std::string complaint;
  try {
    expect_shaft_plot("shaft.svg");
  } catch (const Error& error) {
    complaint = error.what();
  }
  const std::string without_page =
      "--plot: this ballbar was built without its page: expected node and npm when it was built; on Debian install "
      "nodejs and npm, then run cmake -S . -B build -DBALLBAR_PAGE=ON && cmake --build build.";
  EXPECT_EQ(complaint, page::kScript.empty() ? without_page : "");
  EXPECT_NO_THROW(expect_shaft_plot("shaft.png"));
}

// A region of 20 by 11 pixels at (4, 5) in 30 by 40, the scale 20 to 40 degC. The mean point is at 5 of 10 mm, column
// 4 + 10 - 0.5, drawn on 14 (lround away from zero: 9.5 is 10) and one to each side, 12 rows beyond the region; T is 40
// at the left, in the region's first row.
TEST(shaft_plot, marks_stand_where_they_belong) {
  ShaftState state = falling();
  state.from = PictureState{};
  state.from->picture = {30, 40, std::vector<std::uint8_t>(3 * 30 * 40, 100)};
  state.from->scale = {{{0, 0, 0}, {1, 1, 1}}, {20.0, 40.0}, false, 20.0};
  state.from->image.region = {4, 5, 20, 11};
  const Colour plain{100, 100, 100}, magenta{230, 0, 230}, black{0, 0, 0}, white{255, 255, 255};
  const Picture across = marked_picture(state);
  EXPECT_EQ(colour_at(across, 14, 0), magenta);
  EXPECT_EQ(colour_at(across, 13, 27), magenta);
  EXPECT_EQ(colour_at(across, 14, 29), plain);
  EXPECT_EQ(colour_at(across, 17, 0), plain);
  EXPECT_EQ(colour_at(across, 4, 5), black);    // T(0) = 40
  EXPECT_EQ(colour_at(across, 23, 15), black);  // T(10) = 20
  EXPECT_EQ(colour_at(across, 14, 10), black);  // T(5) = 30, over the mean point's line
  EXPECT_EQ(colour_at(across, 23, 9), plain);
  EXPECT_EQ(colour_at(across, 24, 8), magenta);  // the region's frame
  EXPECT_EQ(colour_at(across, 4, 8), white);     // the curve's rim

  // Turned: along is down; T = 40 at the top left, the scale's cold end at the right.
  state.from->vertical = true;
  state.from->image.region = {4, 5, 11, 20};
  const Picture down = marked_picture(state);
  EXPECT_EQ(colour_at(down, 4, 5), black);
  EXPECT_EQ(colour_at(down, 14, 24), black);
  EXPECT_EQ(colour_at(down, 0, 15), magenta);
}

}  // namespace
}  // namespace ballbar

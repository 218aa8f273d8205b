#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "page/report_page.hpp"
#include "shaft_picture/shaft_picture.hpp"
#include "shaft_picture/shaft_result.hpp"

namespace ballbar {
namespace {

constexpr Colour kBlack{0, 0, 0}, kWhite{255, 255, 255}, kMagenta{230, 0, 230};
constexpr int kBeyond = 12;  // pixels that a mean-value point's line reaches out of the region

std::string ending_of(const std::string& path) { return std::filesystem::path(path).extension().string(); }

// A picture to draw on: `along` the spindle, `across` it. What is outside is not drawn.
class Canvas {
 public:
  Canvas(Picture picture, const PixelBox& region, bool vertical)
      : picture_(std::move(picture)), region_(region), vertical_(vertical) {}

  void dot(long along, long across, const Colour& colour, long radius) {
    for (long i = along - radius; i <= along + radius; ++i) {
      for (long j = across - radius; j <= across + radius; ++j) set(i, j, colour);
    }
  }
  long length() const { return static_cast<long>(vertical_ ? region_.height : region_.width); }
  long height() const { return static_cast<long>(vertical_ ? region_.width : region_.height); }
  const Picture& picture() const { return picture_; }

 private:
  void set(long along, long across, const Colour& colour) {
    const long x = static_cast<long>(region_.x) + (vertical_ ? across : along);
    const long y = static_cast<long>(region_.y) + (vertical_ ? along : across);
    if (x < 0 || y < 0 || x >= static_cast<long>(picture_.width) || y >= static_cast<long>(picture_.height)) return;
    const std::size_t at = 3 * (static_cast<std::size_t>(y) * picture_.width + static_cast<std::size_t>(x));
    std::copy(colour.begin(), colour.end(), picture_.rgb.begin() + static_cast<std::ptrdiff_t>(at));
  }

  Picture picture_;
  PixelBox region_;
  bool vertical_;
};

void draw_region(Canvas& canvas) {
  for (long i = -1; i <= canvas.length(); ++i) {
    canvas.dot(i, -1, kMagenta, 0);
    canvas.dot(i, canvas.height(), kMagenta, 0);
  }
  for (long j = -1; j <= canvas.height(); ++j) {
    canvas.dot(-1, j, kMagenta, 0);
    canvas.dot(canvas.length(), j, kMagenta, 0);
  }
}

// Where two neighbours belong to different areas: white within black, so that it is seen on any colour.
void draw_borders(Canvas& canvas, const PictureState& from) {
  std::vector<std::pair<long, long>> border;
  const std::size_t width = from.image.region.width;
  for (std::size_t at = 0; at < from.areas.areas.size(); ++at) {
    const Area area = from.areas.areas[at];
    if (area == Area::none) continue;
    const auto other = [&](std::size_t neighbour) {
      return from.areas.areas[neighbour] != Area::none && from.areas.areas[neighbour] != area;
    };
    const bool right = at % width + 1 < width && other(at + 1);
    const bool below = at + width < from.areas.areas.size() && other(at + width);
    if (!right && !below) continue;
    const auto x = static_cast<long>(at % width), y = static_cast<long>(at / width);
    border.emplace_back(from.vertical ? y : x, from.vertical ? x : y);
  }
  for (const auto& [along, across] : border) canvas.dot(along, across, kBlack, 1);
  for (const auto& [along, across] : border) canvas.dot(along, across, kWhite, 0);
}

// T(x) black on white, so that it is seen on any colour; the scale's span over the height of the region.
void draw_curve(Canvas& canvas, const ShaftState& state) {
  const double low = state.from->scale.degC.front(), high = state.from->scale.degC.back();
  const double from_mm = state.profile.x_mm.front(), length = length_mm(state.profile);
  const auto across = [&](long i) {
    const double x_mm = from_mm + (static_cast<double>(i) + 0.5) / static_cast<double>(canvas.length()) * length;
    const double share = (temperature_at(state.profile, x_mm) - low) / (high - low);
    return std::lround((1.0 - std::clamp(share, 0.0, 1.0)) * static_cast<double>(canvas.height() - 1));
  };
  for (const auto& [colour, radius] : {std::pair{kWhite, 2L}, std::pair{kBlack, 1L}}) {
    long before = across(0);
    for (long i = 0; i < canvas.length(); ++i) {
      const long now = across(i);
      for (long j = std::min(before, now); j <= std::max(before, now); ++j) canvas.dot(i, j, colour, radius);
      before = now;
    }
  }
}

void draw_points(Canvas& canvas, const ShaftState& state) {
  for (const SensorPlace& place : state.places) {
    const double share = (place.point.x_mm - state.profile.x_mm.front()) / length_mm(state.profile);
    const long along = std::lround(share * static_cast<double>(canvas.length()) - 0.5);
    for (long j = -kBeyond; j < canvas.height() + kBeyond; ++j) canvas.dot(along, j, kMagenta, 1);
  }
}

}  // namespace

void expect_shaft_plot(const std::string& path) {
  if (ending_of(path) == ".svg") expect_page("--plot");
}

nlohmann::ordered_json mean_point_part(const std::vector<ShaftState>& states, const std::optional<BestPoint>& best,
                                       const Paragraph& conclusion) {
  ShaftPart part{conclusion, best, {}};
  for (const ShaftState& state : states) part.states.push_back({state});
  return json_of(part);
}

Picture marked_picture(const ShaftState& state) {
  Canvas canvas(state.from->picture, state.from->image.region, state.from->vertical);
  draw_borders(canvas, *state.from);
  draw_region(canvas);
  draw_points(canvas, state);
  draw_curve(canvas, state);
  return canvas.picture();
}

void plot_shaft(const std::vector<ShaftState>& states, const std::optional<BestPoint>& best,
                const Paragraph& conclusion, const std::string& path) {
  expect_shaft_plot(path);
  if (ending_of(path) == ".svg") {
    write_bytes(path, plot_of({{"mean_point", mean_point_part(states, best, conclusion)}}, text_of(conclusion)));
    return;
  }
  if (states.size() != 1 || !states.front().from) {
    throw Error(fmt::format("--plot {}: expected one picture to draw on, found {}; an .svg draws both.", path,
                            states.front().from ? fmt::format("{}", states.size()) : "a table"));
  }
  write_bytes(path, write_png(marked_picture(states.front())));
}

}  // namespace ballbar

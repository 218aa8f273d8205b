#include "mean_point/meanpoint_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"
#include "ballbar/formats/text/bytes.hpp"
#include "programs/gnuplot.hpp"
#include "terminal/text.hpp"

namespace ballbar {
namespace {

// Colours that all kinds of colour vision tell apart (Okabe, Ito 2008).
constexpr std::array<const char*, 6> kLines{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};
constexpr Colour kBlack{0, 0, 0}, kWhite{255, 255, 255}, kMagenta{230, 0, 230};
constexpr std::size_t kMostSamples = 2000;  // of a curve
constexpr int kBeyond = 12;                 // pixels that a mean-value point's line reaches out of the region

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
    const auto other = [&](std::size_t beside) {
      return from.areas.areas[beside] != Area::none && from.areas.areas[beside] != area;
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
void draw_curve(Canvas& canvas, const MeanPointState& state) {
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

void draw_points(Canvas& canvas, const MeanPointState& state) {
  for (const MeanPoint& point : state.points) {
    const double share = (point.x_mm - state.profile.x_mm.front()) / length_mm(state.profile);
    const long along = std::lround(share * static_cast<double>(canvas.length()) - 0.5);
    for (long j = -kBeyond; j < canvas.height() + kBeyond; ++j) canvas.dot(along, j, kMagenta, 1);
  }
}

}  // namespace

void expect_meanpoint_plot(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".svg" || ending == ".png") return;
  throw Error(fmt::format("--plot {}: expected a name that ends in .svg or .png, found {}.", path,
                          ending.empty() ? "no ending" : ending));
}

std::string meanpoint_script(const std::vector<MeanPointState>& states, const std::optional<BestPoint>& best,
                             const std::string& heading) {
  std::string script =
      "set encoding utf8\n"
      "set terminal svg size 900,560 noenhanced font 'sans-serif,13' name 'ballbar' background 'white'\n"
      "set border 3 lc rgb '#444444'\nset tics nomirror out scale 0.6 textcolor rgb 'black'\n"
      "set grid lc rgb '#E4E4E4' lw 1 lt 1\nset xlabel 'x in mm'\nset ylabel 'temperature in degC'\n"
      "set key outside below horizontal maxrows 4\n";
  std::istringstream lines(wrapped(heading, 110));
  std::string title;
  for (std::string line; std::getline(lines, line);)
    title += (title.empty() ? "" : " . \"\\n\" . ") + gnuplot_quoted(line);
  script += "set title " + title + "\n";
  std::string plots;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const MeanPointState& state = states[k];
    const std::size_t n = state.profile.x_mm.size(), step = n / kMostSamples + 1;
    script += fmt::format("$T{} << EOD\n", k);
    for (std::size_t i = 0; i < n; i += i + 1 < n ? std::min(step, n - 1 - i) : 1) {
      script += fmt::format("{:.9g} {:.9g}\n", state.profile.x_mm[i], state.profile.degC[i]);
    }
    script += fmt::format("EOD\n$M{0} << EOD\n{1:.9g} {3:.9g}\n{2:.9g} {3:.9g}\nEOD\n$P{0} << EOD\n", k,
                          state.profile.x_mm.front(), state.profile.x_mm.back(), state.mean_degC);
    for (const MeanPoint& point : state.points) script += fmt::format("{:.9g} {:.9g}\n", point.x_mm, state.mean_degC);
    script += "EOD\n";
    const char* colour = kLines[k % kLines.size()];
    plots += fmt::format(
        "{0}$T{1} with lines lw 2 lc rgb '{2}' title {3}, $M{1} with lines dt 2 lc rgb '{2}' notitle, "
        "$P{1} with points pt 7 ps 0.9 lc rgb '{2}' notitle",
        k == 0 ? "" : ", ", k, colour, gnuplot_quoted(shortened(state.name, 50)));
  }
  if (best) {
    script += fmt::format("set arrow from {0:.9g},graph 0 to {0:.9g},graph 1 nohead lw 2 lc rgb 'black'\n", best->x_mm);
  }
  return script + "plot " + plots + "\n";
}

Picture marked_picture(const MeanPointState& state) {
  Canvas canvas(state.from->picture, state.from->image.region, state.from->vertical);
  draw_borders(canvas, *state.from);
  draw_region(canvas);
  draw_points(canvas, state);
  draw_curve(canvas, state);
  return canvas.picture();
}

void plot_meanpoint(const std::vector<MeanPointState>& states, const std::optional<BestPoint>& best,
                    const std::string& heading, const std::string& path) {
  expect_meanpoint_plot(path);
  if (ending_of(path) == ".svg") {
    write_bytes(path, svg_by_gnuplot(meanpoint_script(states, best, heading)));
    return;
  }
  if (states.size() != 1 || !states.front().from) {
    throw Error(fmt::format("--plot {}: expected one picture to draw on, found {}; an .svg draws both.", path,
                            states.front().from ? fmt::format("{}", states.size()) : "a table"));
  }
  write_bytes(path, write_png(marked_picture(states.front())));
}

}  // namespace ballbar

#include "temperature/colour_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"

namespace ballbar {
namespace {

constexpr double kLumaWeight = 2.0;
constexpr std::size_t kShortest = 8;  // of a legend, pixels
constexpr std::size_t kBlurred = 2;   // lines at its ends
constexpr std::size_t kFewestBands = 3;
constexpr std::size_t kNarrowestBand = 8;  // pixels
constexpr double kWithin = 0.11;           // of a band's step
constexpr double kLeastStep = 6.0;         // between bands, levels of 255
constexpr double kOneColour = 20.0;        // levels of 255

void check_ends(double min_degC, double max_degC) {
  if (min_degC >= -kLargest_degC && max_degC <= kLargest_degC && max_degC > min_degC) return;
  throw Error(fmt::format(
      "the scale needs a largest temperature above its least, both within {:g} degC of 0; found {} to {} degC",
      kLargest_degC, min_degC, max_degC));
}

// Of the pixels that `pixel_at` gives for 0 to n - 1.
template <class PixelAt>
Colour median_colour(std::size_t n, const PixelAt& pixel_at) {
  Colour result{};
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<std::uint8_t> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(pixel_at(i)[c]);
    result[c] = median(std::move(values));
  }
  return result;
}

// Cold first.
std::vector<Colour> lines_of(const Picture& picture, const PixelBox& box) {
  const bool upright = box.height >= box.width;
  const std::size_t length = std::max(box.width, box.height), across = std::min(box.width, box.height);
  const std::size_t margin = across / 4;
  std::vector<Colour> lines;
  for (std::size_t i = 0; i < length; ++i) {
    lines.push_back(median_colour(across - 2 * margin, [&](std::size_t j) {
      return upright ? colour_at(picture, box.x + margin + j, box.y + length - 1 - i)
                     : colour_at(picture, box.x + i, box.y + margin + j);
    }));
  }
  for (std::size_t i = 0; i < kBlurred; ++i) {
    lines[i] = lines[kBlurred];
    lines[length - 1 - i] = lines[length - 1 - kBlurred];
  }
  return lines;
}

double change(const Colour& a, const Colour& b) {
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(sum);
}

// The colours of n bands of equal width, the least n for which colour changes between the middles of the bands and not
// within them; empty where there is none. Where colour changes evenly, the scatter in the middle half of a stretch is
// 1 / (2 sqrt 12) = 0.14 of the step to the next.
std::vector<Colour> bands_of(const std::vector<Colour>& lines) {
  for (std::size_t n = kFewestBands; n <= lines.size() / kNarrowestBand; ++n) {
    const double length = static_cast<double>(lines.size()) / static_cast<double>(n);
    std::vector<Colour> bands;
    double within = 0.0, between = 0.0;
    std::size_t counted = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto begin = static_cast<std::size_t>(std::lround((static_cast<double>(i) + 0.25) * length));
      const auto end = static_cast<std::size_t>(std::lround((static_cast<double>(i) + 0.75) * length));
      const auto stretch = std::span(lines).subspan(begin, end - begin);
      bands.push_back(median_colour(stretch.size(), [&](std::size_t j) { return stretch[j]; }));
      for (const Colour& colour : stretch) within += change(colour, bands.back()) * change(colour, bands.back());
      counted += stretch.size();
      if (bands.size() < 2) continue;
      const double step = change(bands[bands.size() - 2], bands.back());
      between += step * step;
    }
    within = std::sqrt(within / static_cast<double>(counted));
    between = std::sqrt(between / static_cast<double>(n - 1));
    if (within < kWithin * between && between > kLeastStep) return bands;
  }
  return {};
}

}  // namespace

Luma luma_of(const Colour& colour) {
  const double r = colour[0], g = colour[1], b = colour[2];
  const double y = 0.299 * r + 0.587 * g + 0.114 * b;
  return {kLumaWeight * y, 0.564 * (b - y), 0.713 * (r - y)};
}

OnScale nearest_on_scale(const ColourScale& scale, const std::vector<Luma>& line, const Luma& colour) {
  double least = std::numeric_limits<double>::infinity(), degC = 0.0;
  const auto consider = [&](double distance2, double at_degC) {
    if (distance2 >= least) return;
    least = distance2;
    degC = at_degC;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Luma& p = line[i];
    const Luma d{colour[0] - p[0], colour[1] - p[1], colour[2] - p[2]};
    consider(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], scale.degC[i]);
    if (scale.banded || i + 1 == line.size()) continue;
    const Luma v{line[i + 1][0] - p[0], line[i + 1][1] - p[1], line[i + 1][2] - p[2]};
    const double vv = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (vv == 0.0) continue;
    const double s = (d[0] * v[0] + d[1] * v[1] + d[2] * v[2]) / vv;
    if (s <= 0.0 || s >= 1.0) continue;
    const Luma e{d[0] - s * v[0], d[1] - s * v[1], d[2] - s * v[2]};
    consider(e[0] * e[0] + e[1] * e[1] + e[2] * e[2], (1.0 - s) * scale.degC[i] + s * scale.degC[i + 1]);
  }
  return {degC, std::sqrt(least)};
}

ColourScale scale_of(std::vector<Colour> colours, double min_degC, double max_degC) {
  check_ends(min_degC, max_degC);
  if (colours.size() < 2) throw Error(fmt::format("a scale needs at least two colours; there are {}", colours.size()));
  ColourScale scale{std::move(colours), {}, false, 0.0};
  scale.step_degC = (max_degC - min_degC) / static_cast<double>(scale.colours.size() - 1);
  for (std::size_t i = 0; i < scale.colours.size(); ++i) {
    scale.degC.push_back(min_degC + static_cast<double>(i) * scale.step_degC);
  }
  return scale;
}

ColourScale legend_scale(const Picture& picture, const PixelBox& box, double min_degC, double max_degC) {
  check_ends(min_degC, max_degC);
  expect_inside(picture, box, "the legend");
  const std::size_t n = std::max(box.width, box.height);
  if (n < kShortest) throw Error(fmt::format("the legend needs at least {} pixels of length; found {}", kShortest, n));
  ColourScale scale;
  const std::vector<Colour> lines = lines_of(picture, box);
  const std::vector<Colour> bands = bands_of(lines);
  scale.banded = !bands.empty();
  scale.colours = scale.banded ? bands : lines;
  const bool one = std::all_of(scale.colours.begin(), scale.colours.end(),
                               [&](const Colour& c) { return change(c, scale.colours.front()) < kOneColour; });
  if (one) throw Error("the legend needs colours that change along its longer side; found one colour");
  // A line of pixels, as a band, stands for the temperature in its middle.
  scale.step_degC = (max_degC - min_degC) / static_cast<double>(scale.colours.size());
  for (std::size_t i = 0; i < scale.colours.size(); ++i) {
    scale.degC.push_back(min_degC + (static_cast<double>(i) + 0.5) * scale.step_degC);
  }
  return scale;
}

void expect_inside(const Picture& picture, const PixelBox& box, const char* what) {
  const bool inside = box.width > 0 && box.height > 0 && box.width <= picture.width && box.height <= picture.height &&
                      box.x <= picture.width - box.width && box.y <= picture.height - box.height;
  if (inside) return;
  throw Error(fmt::format("{} needs to be in the picture of {} by {} pixels; found {},{},{},{}", what, picture.width,
                          picture.height, box.x, box.y, box.width, box.height));
}

}  // namespace ballbar

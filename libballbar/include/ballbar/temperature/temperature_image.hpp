// Converts a picture of temperatures back into numbers. Each pixel takes the temperature of the nearest colour on the
// scale; the temperature along the spindle is the mean over each column of pixels.
//
// The scale is a polyline through its colours in red, green, blue, as programs paint it. The nearest point is searched
// in luma and the two colour differences (ITU-R BT.601, as JPEG stores them; a linear transformation). Luma has twice
// the weight, because JPEG at 4:2:0 stores it with four times the pixels. A banded scale, as finite-element programs
// draw, has no points between its bands.
//
// These pixels are left out and counted: pixels off the scale (background, text, outlines); white or black paper from
// the border of the picture inwards, if it makes up most of the border, even if the scale has that colour; pixels that
// differ from the median of the surrounding 7 by 7 pixels by more than a tenth of the scale (lines and letters in
// colours of the scale); pixels within edge_px of any of these or of the legend, where JPEG blurs the colours.
//
// Sigma of T of a column is the scatter of its pixels over the root of an eighth of their number (the 8 by 8 blocks of
// JPEG share their error), propagated through the smoothing. It excludes common errors: step_degC / sqrt(12) of the
// scale, and errors of its ends.
//
// Accuracy, measured on painted shafts of 330 mm, 660 pixels, 22 to 48 degC, JPEG quality 80, twelve curves a scale
// (tests/formats/meanpoint_accuracy_test.cpp): smooth scales jet, turbo, viridis, inferno, gray, hot, by map or legend:
// mean within 0.2 % of the scale's span, mean-value point within 1.4 mm; 18 bands: 0.2 %, 1.1 mm; 9 bands: 1.4 %, 6.4
// mm. The slope at the point is within 0.013 degC/mm of smooth scales, 3 of its sigma; of bands within 0.02, where the
// whole step as its sigma is 3 to 10 times too wide. Bands of less than 12 pixels in the legend whose colours differ
// little (viridis, 18) may pass for a smooth scale.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "ballbar/temperature/mean_point.hpp"
#include "ballbar/temperature/picture.hpp"

namespace ballbar {

struct ColourScale {
  std::vector<Colour> colours;  // n >= 2, cold first
  std::vector<double> degC;     // n, rising; of a band its middle
  bool banded = false;
  double step_degC = 0.0;  // width of a band, or step between neighbouring colours: the resolution of T
};

// A colour map with colours evenly spaced from min to max. Throws Error: less than two colours, max not above min.
ColourScale scale_of(std::vector<Colour> colours, double min_degC, double max_degC);

// The scale from a legend bar in the picture. `box` lies inside the frame of the bar; the hot end is at the top or at
// the right. Each line of pixels across the longer side gives the median colour of its middle part. The two lines at
// each end take the colour of the third. The scale is banded if nearly all colour changes are in a few steps. Throws
// Error: a box outside the picture or shorter than 8 pixels, a single colour, max not above min.
ColourScale legend_scale(const Picture& picture, const PixelBox& box, double min_degC, double max_degC);

inline constexpr int kWidestEdge_px = 100;

// Without a region, the pixels on the scale must be connected. Parts that are more than 8 pixels apart in columns or
// rows may be a spindle and an unstated legend; they are an error, which names their boxes.
struct ImageOptions {
  std::optional<PixelBox> region;  // nullopt: bounding box of the pixels on the scale, without the legend
  std::optional<PixelBox> legend;  // excluded from the analysis
  std::size_t edge_px = 3;         // at most kWidestEdge_px
};

struct TemperatureImage {
  PixelBox region;
  std::vector<double> degC;  // of the region's pixels, row by row; NaN: left out
  std::size_t used = 0, off_scale = 0, contrasting = 0, at_edges = 0;  // pixels of the region
  // Used pixels within 1 % of the span from the end colours (all lines of a legend with that colour): they may be at
  // any temperature beyond. Not counted for a banded scale, whose end bands are as wide as the others.
  std::size_t at_cold_end = 0, at_hot_end = 0;
  // The scale ends too early: more than 3 % of the used pixels are at that end, and more than 4 times as many as in the
  // next interval of the same width. A field with a flat maximum of its own gives 2 to 3 times as many.
  bool saturated_cold = false, saturated_hot = false;
};

// Throws Error: a region or a legend outside the picture, too wide an edge, no pixel on the scale, several separate
// parts without a stated region.
TemperatureImage temperature_image(const Picture& picture, const ColourScale& scale, const ImageOptions& options);

struct ImageProfile {
  TemperatureProfile profile;  // at from, at the middle of each column, at to; local linear smoothing over `window`
  std::size_t columns = 0, empty_columns = 0;  // empty: less than 3 pixels; T is interpolated
  std::size_t window = 0;                      // columns
  double sigma_mean_degC = 0.0;                // of the mean over x: scatter and step of the scale
};

// from_mm and to_mm are the positions of the left and the right edge of the region. vertical: of the top and the
// bottom, and rows replace columns. Throws Error: to_mm less than 0.1 mm above from_mm, positions beyond
// kLargestPlace_mm, less than 8 columns with pixels.
ImageProfile image_profile(const TemperatureImage& image, const ColourScale& scale, double from_mm, double to_mm,
                           bool vertical);

}  // namespace ballbar

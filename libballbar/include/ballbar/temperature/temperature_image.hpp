// A picture of temperature turned back into numbers: each pixel's colour to the nearest place on the colour scale, and
// the temperature along the spindle as the mean over each column of pixels.
//
// The scale is a line through its colours in red, green, blue, straight between neighbours, as programs paint it. The
// nearest place is looked for in luma and the two colour differences (ITU-R BT.601, what JPEG stores; a linear change
// of coordinates, so the line stays one), luma counted twice, for JPEG at 4:2:0 keeps it at four times the pixels. A
// banded scale, as finite-element programs draw, has no places between its bands.
//
// Left out, and counted: pixels off the scale (background, text, outlines), and white or black paper from the picture's
// border inwards where most of the border is that, even if the scale has that colour; pixels that differ from the
// median of the 7 by 7 pixels around them by more than a tenth of the scale (lines and letters whose colour is on the
// scale); and those within edge_px of either, or of the picture's legend, where JPEG lets colours run into each other.
//
// Sigma of T of a column: the scatter of its pixels over the root of an eighth of their number (JPEG's blocks of 8 by 8
// share their error), carried through the smoothing. What all columns share is not in it: step_degC / sqrt(12) of the
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
  double step_degC = 0.0;  // of a band, or between neighbouring colours: T is known to that
};

// Colours spread evenly from min to max, as a colour map. Throws Error: less than two colours, max not above min.
ColourScale scale_of(std::vector<Colour> colours, double min_degC, double max_degC);

// From the legend bar in a picture, box inside its frame: the median colour of the middle of each line of pixels across
// the longer side, the hot end at the top or at the right. The two lines at each end take the colour of the third. It
// is banded where nearly all change of colour is in a few steps. Throws Error: a box outside the picture or shorter
// than 8 pixels, one colour only, max not above min.
ColourScale legend_scale(const Picture& picture, const PixelBox& box, double min_degC, double max_degC);

inline constexpr int kWidestEdge_px = 100;

// Without a region, what is on the scale must hang together: stretches of columns, or of rows, apart by more than 8
// pixels may be a spindle and a legend that was not stated, and are an error that names their boxes.
struct ImageOptions {
  std::optional<PixelBox> region;  // default: the bounding box of what is on the scale, without the legend
  std::optional<PixelBox> legend;  // never part of what is looked at
  std::size_t edge_px = 3;         // at most kWidestEdge_px
};

struct TemperatureImage {
  PixelBox region;
  std::vector<double> degC;  // of the region's pixels, row by row; NaN: left out
  std::size_t used = 0, off_scale = 0, contrasting = 0, at_edges = 0;  // pixels of the region
  // Of those used, within 1 % of the span of the end colours (all lines of a legend that have it): what they show may
  // be any temperature beyond. Not counted for a banded scale, whose ends are as wide as the other bands.
  std::size_t at_cold_end = 0, at_hot_end = 0;
  // The scale ends too early: more than 3 % of the pixels used are there, and more than 4 times as many as in the next
  // stretch as wide. A field whose own maximum is flat gives 2 to 3 times, for half of sqrt(2) d lies within d of it.
  bool saturated_cold = false, saturated_hot = false;
};

// Throws Error: a region or a legend outside the picture, too wide an edge, nothing on the scale in it, several things
// apart from each other where no region is stated.
TemperatureImage temperature_image(const Picture& picture, const ColourScale& scale, const ImageOptions& options);

struct ImageProfile {
  TemperatureProfile profile;  // at from, at the middle of each column, at to; smoothed by straight lines over `window`
  std::vector<double> scatter_degC;  // of the pixels of a column, at the same places; at the ends that of the next
  std::size_t columns = 0, empty_columns = 0;  // empty: less than 3 pixels, T is that of the line around them
  std::size_t window = 0;                      // columns
  double sigma_mean_degC = 0.0;                // of the mean over x, scatter and step of the scale
};

// from_mm and to_mm are the left and the right edge of the region; vertical: the top and the bottom, and rows take the
// place of columns. Throws Error: to not 0.1 mm above from, places beyond kLargestPlace_mm, less than 8 columns with
// pixels.
ImageProfile image_profile(const TemperatureImage& image, const ColourScale& scale, double from_mm, double to_mm,
                           bool vertical);

}  // namespace ballbar

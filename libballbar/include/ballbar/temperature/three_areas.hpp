// Mean temperature of a picture by the three areas of the paper: hot, middle and cold, separated by thresholds of the
// red and the blue channel, each with one temperature. The spindle of the paper is a rectangle, so that areas are
// proportional to lengths. To give thick and thin parts of a stepped shaft the same weight, each pixel counts 1 / (the
// pixels of its column).
//
//   S1       hot              red above its threshold
//   S1 + S2  hot and middle   hot, or blue not above its threshold
//   S3       cold             the rest
//   mean     (S1 T1 + S2 T2 + S3 T3) / (S1 + S2 + S3),   S the sum of 1 / (pixels used of the column) over the area
//
// Each threshold combines the triangle method and Otsu's by the union of the selected pixels: the lower threshold for
// "above", the higher one for "not above". The paper does not state the temperature of an area; here it is the middle
// of its third of the scale: T3, T2, T1 = min + (1/6, 3/6, 5/6) (max - min).
//
// Valid only for scales from blue over green to red, such as jet. The method is coarse: on painted shafts of known
// temperature in jet its error is up to 25 % of the span of the scale, with Otsu's thresholds alone up to 7 %
// (tests/formats/meanpoint_accuracy_test.cpp). temperature_image.hpp is more accurate.
//
// Source: Huang, Li, Zhao 2022, doi 10.19650/j.cnki.cjsi.J2209226, section 3.2, eq. 22 to 28, fig. 10.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ballbar/temperature/picture.hpp"
#include "ballbar/temperature/temperature_image.hpp"

namespace ballbar {

using Histogram = std::array<std::uint32_t, 256>;  // pixels of each level 0 to 255

// Eq. 22 to 28: the level k for which the classes i <= k and i > k have the largest variance between each other,
//   s^2 = P1 (m1 - mG)^2 + P2 (m2 - mG)^2 = P1 P2 (m1 - m2)^2,
// the lowest one if there are several; 0 for less than two levels. Equals OpenCV's, except that OpenCV may take another
// one of several.
int otsu_threshold(const Histogram& histogram);

// Triangle method (Zack, Rogers, Latt 1977): draw a line from the peak of the histogram to its farther end; the
// threshold is just below the level whose count is farthest below that line. Returns -1 to 255, exactly as OpenCV does.
int triangle_threshold(const Histogram& histogram);

enum class Area : std::uint8_t { none, cold, middle, hot };  // none: a pixel that was left out

struct ThreeAreas {
  int red_otsu = 0, red_triangle = 0, blue_otsu = 0, blue_triangle = 0;
  std::size_t hot = 0, middle = 0, cold = 0;                     // pixels
  double hot_share = 0.0, middle_share = 0.0, cold_share = 0.0;  // S1, S2, S3 over their sum
  double mean_degC = 0.0;
  double otsu_mean_degC = 0.0;  // the same by Otsu's thresholds alone
  std::vector<Area> areas;      // of the region's pixels, row by row
};

// Uses the pixels that `image` uses; `image` must be made from `picture`. vertical: the spindle runs from top to
// bottom, and rows replace columns.
ThreeAreas three_areas(const Picture& picture, const TemperatureImage& image, double min_degC, double max_degC,
                       bool vertical);

}  // namespace ballbar

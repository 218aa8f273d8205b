// Mean temperature of a picture by the paper's three areas: hot, middle and cold by thresholds of the red and the blue
// channel, each area at one temperature. The paper's spindle is a rectangle, whose areas over its height are lengths;
// so that a thick part of a stepped shaft weighs no more than a thin one, each pixel counts 1 / the pixels of its
// column.
//
//   S1       hot              red above its threshold
//   S1 + S2  hot and middle   hot, or blue not above its threshold
//   S3       cold             the rest
//   mean     (S1 T1 + S2 T2 + S3 T3) / (S1 + S2 + S3),   S the sum of 1 / (pixels used of the column) over the area
//
// Each threshold is that of the triangle and that of Otsu used together, the union of what they select: the lower one
// for "above", the higher one for "not above". The paper does not state the temperature of an area; here it is the
// middle of its third of the scale: T3, T2, T1 = min + (1/6, 3/6, 5/6) (max - min).
//
// For scales from blue over green to red only, such as jet; for others the areas mean nothing. Accuracy: coarse even
// there. On painted shafts of known temperature in jet it is off by up to 25 % of the scale's span, by Otsu's
// thresholds alone up to 7 % (tests/formats/meanpoint_accuracy_test.cpp); the inversion of temperature_image.hpp is the
// better way.
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
// the lowest of several; 0 where there are less than two levels. As OpenCV's, which may take another of several.
int otsu_threshold(const Histogram& histogram);

// Triangle (Zack, Rogers, Latt 1977): a line from the top of the histogram to the farther of its ends; the threshold is
// below the level whose count is farthest under that line. -1 to 255; exactly OpenCV's, which steps one level towards
// the end and one level beyond it.
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

// Of the pixels that `image` uses, in its region of `picture`, of which it must be made. vertical: the spindle runs
// from top to bottom, and rows take the place of columns.
ThreeAreas three_areas(const Picture& picture, const TemperatureImage& image, double min_degC, double max_degC,
                       bool vertical);

}  // namespace ballbar

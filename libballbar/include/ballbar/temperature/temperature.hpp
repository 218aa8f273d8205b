// Temperatures along a spindle: from a picture, and the one place where a sensor reads their mean.
//
//   legend_scale(), temperature_image(), image_profile()   a picture with a colour scale -> degC along the spindle
//   mean_points(), best_point()                            the mean-value point, and one for several states
//   three_areas()                                          the coarse method of the paper, for comparison
//
// Every temperature has the sigma of its pixels; errors of the scale itself are common to all and stated apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ballbar {

// ---- A picture in memory: 8-bit red, green, blue, row by row from the top, as screens and files have it.

using Colour = std::array<std::uint8_t, 3>;  // red, green, blue

struct Picture {
  std::size_t width = 0;          // pixels
  std::size_t height = 0;         // pixels
  std::vector<std::uint8_t> rgb;  // 3 width height values
};

// A rectangle of pixels: columns x to x + width - 1, rows y to y + height - 1, counted from the top left corner.
struct PixelBox {
  std::size_t x = 0, y = 0, width = 0, height = 0;
};

// The pixel in column x and row y; both must be in the picture.
inline Colour colour_at(const Picture& picture, std::size_t x, std::size_t y) {
  const std::size_t at = 3 * (y * picture.width + x);
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

// ---- The best position for one sensor: the mean-value point of the temperature along a spindle.
//
//   eq. 20, 21   (T(xi) - T0) L = integral over L of (T(x) - T0) dx,     dL = alpha L (T(xi) - T0)
//
// A sensor at xi reads the mean temperature, and the axial elongation follows from this one reading. There may be
// several xi. A sensor misplaced by 1 mm causes an error of alpha L |dT/dx|, so that the xi with the smallest slope is
// the least sensitive. As the spindle warms up, T(x) changes its shape and xi moves; best_point() is one position for
// several states.
//
// T is linear between the samples; mean, points and best point are exact for this curve. An error of T that is the same
// everywhere (an offset of the scale) changes the mean but not xi.
//
// Source: Huang, Li, Zhao 2022, doi 10.19650/j.cnki.cjsi.J2209226, section 3.1. Of its table 1, model of dL, 16 of 17
// rows follow from eq. 21 to the printed digit; the row at 30.7 degC prints 18.50 um where it gives 18.40.

inline constexpr double kLargestPlace_mm = 1e6, kLargest_degC = 1e6;  // either side of 0: far beyond any machine

struct TemperatureProfile {
  std::vector<double> x_mm;        // n >= 2, rising by at least 1e-6 mm, within kLargestPlace_mm
  std::vector<double> degC;        // n, within kLargest_degC
  std::vector<double> sigma_degC;  // n, 0 to kLargest_degC, of each sample; empty: not known
};

double length_mm(const TemperatureProfile& profile);

// T at x; outside the profile that of the nearest end. O(log n). These two functions do not check the profile.
double temperature_at(const TemperatureProfile& profile, double x_mm);
double sigma_at(const TemperatureProfile& profile, double x_mm);  // NaN: not known

// (1 / L) integral of T dx.
double mean_degC(const TemperatureProfile& profile);

// The standard uncertainty of the mean if all samples have the same error, which is the upper limit: sum w_i sigma_i,
// where w_i is half the distance of the neighbours of x_i, over L. A common error (one scale, one camera, one
// reference) does not shrink with the number of samples. For n independent errors it would be about 1 / sqrt(n) of
// this. NaN if not known.
double sigma_of_mean_degC(const TemperatureProfile& profile);

// A point where T equals the level. At a crossing from_mm = x_mm = to_mm; if T stays at the level, x_mm is the middle
// of the interval.
//
// The slope is that of the chord (T(q) - T(p)) / (q - p), because the difference of neighbours is mostly scatter. p and
// q are 2 % of L before and behind, or at the samples on both sides if those are farther. Several crossings counted as
// one use their interval extended by its own length at both sides, if that is more. The slope is 0 where T stays at the
// level. Its sigma is hypot(sigma(p), sigma(q)) / (q - p); NaN if that of T is not known.
struct MeanPoint {
  double x_mm = 0.0;
  double from_mm = 0.0, to_mm = 0.0;
  double slope_degC_per_mm = 0.0;
  double chord_from_mm = 0.0, chord_to_mm = 0.0;  // p, q
};
double sigma_of_slope_degC_per_mm(const TemperatureProfile& profile, const MeanPoint& point);

// All points where T equals the level, in rising order. Crossings between which T stays within same_degC (>= 0) of the
// level are one point, because a noisy curve crosses many times. The mean has at least one point. These functions and
// those below throw Error for a profile that is not as described above, or not finite.
std::vector<MeanPoint> points_at(const TemperatureProfile& profile, double level_degC, double same_degC = 0.0);
std::vector<MeanPoint> mean_points(const TemperatureProfile& profile, double same_degC = 0.0);

// Eq. 21: alpha L times the rise of the mean temperature.
double mean_point_elongation_um(double expansion_ppm_per_K, double length_mm, double rise_K);

// alpha L |dT/dx|: error of dL in um per mm of misplacement of the sensor.
double misplacement_um_per_mm(const TemperatureProfile& profile, const MeanPoint& point, double expansion_ppm_per_K);

// The x, within all profiles, with the smallest root mean square of alpha L_k (T_k(x) - mean_k) over the profiles k;
// the lowest x if there are several.
struct BestPoint {
  double x_mm = 0.0;
  double rms_um = 0.0;
  std::vector<double> error_um;      // per profile: elongation from a sensor at x minus true elongation
  double misplaced_um_per_mm = 0.0;  // the largest alpha L_k |dT_k/dx| at x, slopes of chords as above
};
BestPoint best_point(std::span<const TemperatureProfile> profiles, double expansion_ppm_per_K);

// The uncertainty of a mean-value point, from a profile whose temperatures have a sigma.

// The tolerance for points_at(): two sigma of T, without the common error, where T first reaches the level. 0 if sigma
// is not known or T never reaches the level.
double same_degC(const TemperatureProfile& profile, double level_degC);

// The profile with the standard uncertainty of a scale with steps, step / sqrt(12), added to the sigma of T.
TemperatureProfile with_step(TemperatureProfile profile, double step_degC);

// Sorted by slope, the least sensitive to a misplaced sensor first.
std::vector<MeanPoint> flattest_first(std::vector<MeanPoint> points);

// sigma of xi = hypot(sigma of T over its slope, edge_sigma_mm, half the interval in which T cannot be distinguished
// from the mean). edge_sigma_mm is that of the ends of the profile. NaN if the sigma of T is not known.
double sigma_of_place_mm(const TemperatureProfile& profile, const MeanPoint& point, double edge_sigma_mm);

// ---- Converts a picture of temperatures back into numbers. Each pixel takes the temperature of the nearest colour on
// the scale; the temperature along the spindle is the mean over each column of pixels.
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

// ---- Mean temperature of a picture by the three areas of the paper: hot, middle and cold, separated by thresholds of
// the red and the blue channel, each with one temperature. The spindle of the paper is a rectangle, so that areas are
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
// (tests/formats/meanpoint_accuracy_test.cpp). temperature.hpp is more accurate.
//
// Source: Huang, Li, Zhao 2022, doi 10.19650/j.cnki.cjsi.J2209226, section 3.2, eq. 22 to 28, fig. 10.

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

// Paints pictures of a shaft temperature like those of finite-element programs and thermal cameras. The temperature
// field is known, so that they can test the reading of such pictures.
//
// The picture shows the silhouette of the shaft without a bore on white, with a black outline of one pixel: a cylinder
// of shaft_radius_mm up to nose_mm, of tool_radius_mm beyond. Length and radius have the same scale, as large as fits.
// The column of pixels with its middle at x has the colour of T(x), interpolated linearly between the points of the
// profile and constant beyond them. Above it is one line of text that begins with SIMULATED. To the right is a legend
// bar of temperature with five numbers, the hottest at the top. In a build without pictures it throws as colour_map()
// does.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "ballbar/lab/spindle/finite_volume_spindle.hpp"
#include "ballbar/temperature/temperature.hpp"

namespace ballbar {

struct ShaftPictureStyle {
  std::string colours = "jet";           // a name that colour_map() knows
  bool legend = true;                    // false: the reader of the picture needs the scale from elsewhere
  std::size_t bands = 0;                 // 0: smooth; else the scale is cut into so many steps of one colour, 2 to 64
  std::optional<double> from_mm, to_mm;  // part of the shaft, from the rear end; without: all of it
  std::optional<double> min_degC, max_degC;  // of the scale; without: the part's field rounded outwards to whole degC
  std::size_t width_px = 640, height_px = 180;  // 200 to 4000, 100 to 4000
  std::string text;                             // after SIMULATED
};

struct ShaftPicture {
  Picture picture;
  PixelBox shaft;               // of the silhouette: its left edge is from_mm, its right edge to_mm
  std::optional<PixelBox> bar;  // of the legend, without its outline
  double min_degC = 0.0, max_degC = 0.0;
};

// Throws Error: a part outside the shaft, a scale that does not rise, a size out of bounds, a part too short or too
// long for that size, an unknown colour map.
ShaftPicture shaft_picture(const FiniteVolumeSpindle& body, const TemperatureProfile& shaft,
                           const ShaftPictureStyle& style);

}  // namespace ballbar

// Pictures of a shaft's temperature, painted as finite-element programs and thermal cameras give them, for trying what
// reads such pictures: the temperature field is known.
//
// The shaft's silhouette, a bore left out: a cylinder of shaft_radius_mm up to nose_mm, tool_radius_mm beyond, on
// white, with a black outline of one pixel around it; axis and radius in one scale, as large as the place allows. The
// column of pixels whose middle is at x has the colour of T(x), straight lines between the profile's points, its first
// and last value held beyond them. Above it one line of text, which begins with SIMULATED; to the right a legend bar of
// temperature, hottest at the top, with five numbers. Library ballbar::images; built without pictures the functions
// throw what colour_map throws.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "ballbar/lab/spindle/finite_volume_spindle.hpp"
#include "ballbar/temperature/picture.hpp"

namespace ballbar {

struct ShaftPictureStyle {
  std::string colours = "jet";           // a name that colour_map knows
  bool legend = true;                    // false: a reader must be told the scale
  std::size_t bands = 0;                 // 0: smooth; else the scale is cut into so many steps of one colour, 2 to 64
  std::optional<double> from_mm, to_mm;  // part of the shaft, from the rear end; without: all of it
  std::optional<double> min_degC, max_degC;  // of the scale; without: the part's field rounded outwards to whole degC
  std::size_t width_px = 640, height_px = 180;  // 200 to 4000, 100 to 4000
  std::string text;                             // behind SIMULATED
};

struct ShaftPicture {
  Picture picture;
  PixelBox shaft;               // of the silhouette: its left edge is from_mm, its right edge to_mm
  std::optional<PixelBox> bar;  // of the legend, without its outline
  double min_degC = 0.0, max_degC = 0.0;
};

// Throws Error: a part that is not of the shaft, a scale that does not rise, sizes out of bounds, a part too short or
// too long to be painted in that size, an unknown colour map.
ShaftPicture shaft_picture(const FiniteVolumeSpindle& body, const TemperatureProfile& shaft,
                           const ShaftPictureStyle& style);

}  // namespace ballbar

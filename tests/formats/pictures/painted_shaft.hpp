// A picture of a shaft whose temperature along x is known, as a finite-element program or a thermal camera's software
// would show it: silhouette with steps on white, black outline, a title, a legend bar with frame and numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ballbar/temperature/temperature.hpp"

namespace ballbar {

inline constexpr double kShaft_mm = 330.0;
inline constexpr double kLow_degC = 22.0, kHigh_degC = 48.0;
inline constexpr PixelBox kShaftBox{60, 70, 660, 200};   // the silhouette's bounding box
inline constexpr PixelBox kLegendBox{780, 71, 24, 198};  // inside its frame

// Smooth, 23 to 47 degC over 330 mm, at 0.1 mm. Shapes: 0 falls from the nose, 1 two warm bearings, 2 a warm middle, 3
// a slow slope with a wave; the seed draws their widths and places.
inline constexpr int kShapes = 4;
TemperatureProfile known_profile(int shape, std::uint32_t seed);

// bands 0: the colour map's 256 colours; otherwise so many bands, in the shaft and in the legend.
Picture painted_shaft(const TemperatureProfile& profile, std::string_view colours, std::size_t bands = 0);

}  // namespace ballbar

// Parts of temperature.hpp: the place on a scale that is nearest to a colour.
#pragma once

#include <array>
#include <vector>

#include "ballbar/temperature/temperature.hpp"

namespace ballbar {

using Luma = std::array<double, 3>;  // luma, weighted, and the two colour differences
Luma luma_of(const Colour& colour);

struct OnScale {
  double degC = 0.0;
  double distance = 0.0;  // in levels of 255
};

// `line`: luma_of the scale's colours.
OnScale nearest_on_scale(const ColourScale& scale, const std::vector<Luma>& line, const Luma& colour);

// Throws Error where the box is empty or reaches out of the picture.
void expect_inside(const Picture& picture, const PixelBox& box, const char* what);

}  // namespace ballbar

// What `ballbar compensate --from-picture` looks at: temperatures along a spindle, from pictures or from a table, each
// with its mean-value points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/temperature/mean_point.hpp"
#include "ballbar/temperature/picture.hpp"
#include "ballbar/temperature/temperature_image.hpp"
#include "ballbar/temperature/three_areas.hpp"

namespace ballbar {

struct MeanPointOptions {
  std::vector<std::string> files;
  std::optional<double> from_mm, to_mm;
  std::vector<double> min_degC, max_degC;  // one for all pictures or one each
  std::string legend, colours, region;     // boxes as x,y,w,h; empty: not given
  std::optional<long long> edge_px;
  bool vertical = false;
  std::optional<double> start_degC;
  double expansion_ppm_per_K = 11.7;  // of steel
};

// How a picture became a profile.
struct PictureState {
  Picture picture;
  ColourScale scale;
  TemperatureImage image;
  ImageProfile columns;
  ThreeAreas areas;
  bool vertical = false;
};

struct MeanPointState {
  std::string name;            // the picture's file or the table's column
  TemperatureProfile profile;  // its sigma of a picture with the step of the scale; none where that is saturated
  double mean_degC = 0.0;
  double sigma_mean_degC = 0.0;                 // NaN where it is not known
  std::vector<MeanPoint> points;                // flattest first
  std::vector<double> sigma_mm;                 // of points; NaN where it is not known
  std::vector<double> sigma_slope_degC_per_mm;  // of points; NaN where it is not known
  std::optional<PictureState> from;             // of a picture
};

// Throws Error: files that cannot be read, pictures and tables together, options of a picture with a table, an option a
// picture needs, an edge that is no number of pixels, numbers that are not finite or far beyond any machine.
std::vector<MeanPointState> mean_point_states(const MeanPointOptions& options);

}  // namespace ballbar

// The best position of a single sensor for the axial elongation: `ballbar compensate --from-picture`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/message.hpp"
#include "ballbar/temperature/temperature.hpp"

namespace ballbar {

// The input: temperatures along a spindle, from pictures or a table, each with its mean-value points.
struct ShaftPictureOptions {
  std::vector<std::string> files;
  std::optional<double> from_mm, to_mm;
  std::vector<double> min_degC, max_degC;  // one for all pictures or one each
  std::string legend, colours, region;     // boxes as x,y,w,h; empty: not given
  std::optional<long long> edge_px;
  bool vertical = false;
  std::optional<double> start_degC;
  double expansion_ppm_per_K = 11.7;  // of steel
};

// How a picture was converted to a profile.
struct PictureState {
  Picture picture;
  ColourScale scale;
  TemperatureImage image;
  ImageProfile columns;
  ThreeAreas areas;
  bool vertical = false;
};

// A mean-value point with its uncertainty; NaN: not known.
struct SensorPlace {
  MeanPoint point;
  double sigma_mm = 0.0, sigma_slope_degC_per_mm = 0.0;
  double misplaced_um_per_mm = 0.0;  // error of the elongation per mm of misplacement
};

struct ShaftState {
  std::string name;            // the picture's file or the table's column
  TemperatureProfile profile;  // its sigma of a picture with the step of the scale; none where that is saturated
  double mean_degC = 0.0;
  double sigma_mean_degC = 0.0;                              // NaN where it is not known
  std::vector<SensorPlace> places;                           // flattest first
  std::optional<double> elongation_um, sigma_elongation_um;  // since the start, where its temperature is stated
  std::optional<double> error_at_best_um;                    // of a sensor at the best place of several states
  std::optional<PictureState> from;                          // of a picture
};

// Throws Error: files that cannot be read, pictures and tables together, options of a picture with a table, an option a
// picture needs, an edge that is no number of pixels, numbers that are not finite or far beyond any machine.
std::vector<ShaftState> shaft_states(const ShaftPictureOptions& options);

struct ShaftPictureArguments {
  ShaftPictureOptions of;
  std::string out, plot;  // empty: none
  bool json = false;
};

// Prints the positions and writes the requested files. Throws Error with the faulty file or option.
void show_shaft_picture(const ShaftPictureArguments& options);

// Throws Error if the name ends in neither .svg nor .png, or in .svg in a build without the page. Call it before doing
// the work.
void expect_shaft_plot(const std::string& path);

// .svg: T(x) of all states, each mean a dashed line, each mean-value point a dot; the best place of several states a
// line; drawn by the code of the page. .png: the one picture with its region, the borders of the three areas, T(x) (the
// scale's span over the height of the region) and lines at the mean-value points. Throws Error: no node, several
// pictures or a table for a .png, the file cannot be written.
void plot_shaft(const std::vector<ShaftState>& states, const std::optional<BestPoint>& best,
                const Paragraph& conclusion, const std::string& path);

// The data of the .svg, a part of a report, and the picture of the .png.
nlohmann::ordered_json mean_point_part(const std::vector<ShaftState>& states, const std::optional<BestPoint>& best,
                                       const Paragraph& conclusion);
Picture marked_picture(const ShaftState& state);

}  // namespace ballbar

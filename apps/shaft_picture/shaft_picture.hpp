// The best position of a single sensor for the axial elongation: `ballbar compensate --from-picture`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/temperature/mean_point.hpp"
#include "shaft_picture/shaft_states.hpp"

namespace ballbar {

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
                const std::string& conclusion, const std::string& path);

// The data of the .svg, a part of a report, and the picture of the .png.
nlohmann::ordered_json mean_point_part(const std::vector<ShaftState>& states, const std::optional<BestPoint>& best,
                                       const std::string& conclusion);
Picture marked_picture(const ShaftState& state);

}  // namespace ballbar

// Pictures of `ballbar compensate --from-picture`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/temperature/mean_point.hpp"
#include "mean_point/mean_point_states.hpp"

namespace ballbar {

// Throws Error where the name ends in neither .svg nor .png, or in .svg and the program was built without the page; to
// be called before the work is done.
void expect_meanpoint_plot(const std::string& path);

// .svg: T(x) of all states, each mean a dashed line, each mean-value point a dot; the best place of several states a
// line; drawn by the code of the page. .png: the one picture with its region, the borders of the three areas, T(x) (the
// scale's span over the height of the region) and lines at the mean-value points. Throws Error: no node, several
// pictures or a table for a .png, the file cannot be written.
void plot_meanpoint(const std::vector<MeanPointState>& states, const std::optional<BestPoint>& best,
                    const std::string& conclusion, const std::string& path);

// The data of the .svg, a part of a report, and the picture of the .png.
nlohmann::ordered_json mean_point_part(const std::vector<MeanPointState>& states, const std::optional<BestPoint>& best,
                                       const std::string& conclusion);
Picture marked_picture(const MeanPointState& state);

}  // namespace ballbar

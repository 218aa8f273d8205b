// The picture of a comparison: an SVG with one row an axis. Left: both series over time, a as marks, b as a line.
// Right: a - b with the band of +-2 sigma around zero; the stretch of the worst deviation is shaded.
#pragma once

#include <filesystem>
#include <string>

#include "ballbar/drift/comparison.hpp"

namespace ballbar {

// Throws Error where the name does not end in .svg; to be called before the work is done.
void expect_svg(const std::filesystem::path& path);

// The gnuplot script, data included. `heading` stands above the picture, wrapped to at most four lines. A series of
// more than 2000 samples is drawn by the least and the largest of each of 1000 groups of neighbours.
std::string comparison_script(const Comparison& comparison, const std::string& heading);

// Draws it by gnuplot. Throws Error: wrong name, no gnuplot, the file cannot be written.
void plot_comparison(const Comparison& comparison, const std::string& heading, const std::filesystem::path& path);

}  // namespace ballbar

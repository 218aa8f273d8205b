// The report as something to look at: one HTML file with all in it, or single pictures.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

// Throws Error, beginning with `option` if there is one, where the program was built without the page; to be called
// before the work is done.
void expect_page(std::string_view option = {});

// Today; SOURCE_DATE_EPOCH, where it is set: the same page from the same data on any day.
std::string page_date();

// Nothing of the data becomes markup, and the page's content security policy lets nothing run or load but its own
// script. inside: the files that the report was made of (files_inside()), so that a page with the engine goes on with
// them; null: none.
std::string page_of(const nlohmann::ordered_json& report, const nlohmann::ordered_json& inside);

struct NamedPicture {
  std::string name, title, svg;
};

struct PictureOptions {
  std::vector<std::string> names;    // only these; empty: all
  std::vector<std::string> choices;  // "recording=64 min, XY CCW": as the page offers them
  int width_px = 900;
};

// The pictures of the page by node, run as a process. Throws Error: no node; a name or a choice that this report does
// not have, with those that it has.
std::vector<NamedPicture> pictures_of(const nlohmann::ordered_json& report, const PictureOptions& options);

// One ballbar test on a sheet of A4, SVG. `choices`: "error=backlash_a", the error in its picture. By node too. Throws
// Error where the report is not of one test.
std::string handover_of(const nlohmann::ordered_json& report, const std::vector<std::string>& choices);

// For --plot: all pictures of these parts of a report in one .svg, one below the other, under the conclusion. By node
// too.
std::string plot_of(const nlohmann::ordered_json& parts, const std::string& conclusion);

// The whole tool as one HTML file, which is installed beside the program or lies in its tree: copies it to `out` and
// prints what it is for. Throws Error: this program was built without it, or `out` cannot be written.
void write_tool_page(const std::string& out);

}  // namespace ballbar

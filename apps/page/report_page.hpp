// The report as one self-contained HTML file, or as single pictures.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

// Throws Error, beginning with `option` if given, in a build without the page. Call it before doing the work.
void expect_page(std::string_view option = {});

// Today's date, or SOURCE_DATE_EPOCH if set, for reproducible pages.
std::string page_date();

// Data never become markup, and the content security policy of the page allows only its own script. inside: the files
// of the report (files_inside()), so that a page with the engine can continue with them; null: none.
std::string page_of(const nlohmann::ordered_json& report, const nlohmann::ordered_json& inside);

struct NamedPicture {
  std::string name, title, svg;
};

struct PictureOptions {
  std::vector<std::string> names;    // only these; empty: all
  std::vector<std::string> choices;  // "recording=64 min, XY CCW": as the page offers them
  int width_px = 900;
};

// The pictures of the page, drawn by node in a process. Throws Error: no node; an unknown name or choice, with the
// known ones.
std::vector<NamedPicture> pictures_of(const nlohmann::ordered_json& report, const PictureOptions& options);

// One ballbar test, or a thermal test, on an A4 sheet as SVG, drawn by node. `choices`: "error=backlash_a", the error
// in its picture. Throws Error if the report is of neither.
std::string handover_of(const nlohmann::ordered_json& report, const std::vector<std::string>& choices);

// For --plot: all pictures of these parts of a report in one .svg, below each other and below the conclusion, drawn by
// node.
std::string plot_of(const nlohmann::ordered_json& parts, const std::string& conclusion);

// Copies the tool (one HTML file, installed with the program or in its build tree) to `out` and prints its purpose.
// Throws Error if the program was built without it, or `out` cannot be written.
void write_tool_page(const std::string& out);

}  // namespace ballbar

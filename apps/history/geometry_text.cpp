#include "history/geometry_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "history/quantity_text.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

std::string axis_name(int axis) { return std::string(1, "XYZ"[axis]); }

std::string date_of(const MachineTest& test) {
  return test.started_s ? date_text(static_cast<double>(*test.started_s)) : "no date";
}

std::string dates_of(const TestFiles& files, const std::vector<std::size_t>& places) {
  std::vector<std::string> dates;
  for (const std::size_t i : places) {
    const std::string date = date_of(files.tests[i]);
    if (std::find(dates.begin(), dates.end(), date) == dates.end()) dates.push_back(date);
  }
  return fmt::format("{}", fmt::join(dates, ", "));
}

// "planes" where several tell, else "tests of XY".
std::string who_text(const TestFiles& files, const MachineGeometry& geometry) {
  std::vector<Plane> planes;
  for (const ScalePull& pull : geometry.pulls) {
    const Plane plane = files.tests[pull.test].plane;
    if (std::find(planes.begin(), planes.end(), plane) == planes.end()) planes.push_back(plane);
  }
  return planes.size() > 1 ? "planes" : fmt::format("tests of {}", name_of(planes.front()));
}

std::string p_text(double p_value) { return p_value < 0.001 ? "p < 0.001" : fmt::format("p {:.2g}", p_value); }

std::string chi2_text(const MachineGeometry& geometry) {
  return fmt::format("chi^2 {:.1f} at {} degree{} of freedom, {}", geometry.chi2, geometry.degrees,
                     geometry.degrees == 1 ? "" : "s", p_text(geometry.p_value));
}

// How the tests differ of which the axes that several planes tell say different things.
std::vector<std::string> disagreement_texts(const TestFiles& files, const MachineGeometry& geometry) {
  std::vector<std::string> texts{
      fmt::format("The {} disagree on the scales: {}. Sigmas hold {:.1f} um/m by which they scatter beyond theirs.",
                  who_text(files, geometry), chi2_text(geometry), geometry.scatter_ppm)};
  for (const AxisScale& scale : geometry.scales) {
    if (scale.planes < 2) continue;
    std::string tests;
    for (const ScalePull& pull : geometry.pulls) {
      if (pull.axis != scale.axis || !std::isfinite(pull.pull)) continue;
      tests +=
          fmt::format("{}{} {} um/m ({}{:.1f} sigma)", tests.empty() ? "" : ", ", name_of(files.tests[pull.test].plane),
                      with_sigma(pull.value_ppm, pull.sigma_ppm, 1), pull.pull < 0.0 ? "" : "+", pull.pull);
    }
    if (!tests.empty()) texts.push_back(fmt::format("{}: {}.", axis_name(scale.axis), tests));
  }
  return texts;
}

std::vector<std::string> sentences_of(const TestFiles& files, const MachineGeometry& geometry) {
  std::vector<std::string> sentences;
  for (const PlaneSquareness& plane : geometry.squareness) {
    if (plane.p_value >= 0.01) continue;
    sentences.push_back(fmt::format("The tests of {} disagree on the squareness, {}; its sigma is wider for it.",
                                    name_of(plane.plane), p_text(plane.p_value)));
  }
  if (geometry.degrees > 0 && geometry.scatter_ppm == 0.0) {
    sentences.push_back(fmt::format("The {} agree on the scales: {}.", who_text(files, geometry), chi2_text(geometry)));
  } else if (geometry.degrees > 0) {
    for (std::string& text : disagreement_texts(files, geometry)) sentences.push_back(std::move(text));
  }
  if (!geometry.scales.empty()) {
    sentences.emplace_back("Scales are against the bar as it was calibrated: its own error moves all of them alike.");
  }
  return sentences;
}

}  // namespace

GeometryTexts geometry_texts(const TestFiles& files, const MachineGeometry& geometry) {
  GeometryTexts texts;
  if (geometry.squareness.empty() && geometry.scales.empty()) return texts;
  texts.heading = fmt::format(
      "Squareness and scales, {}{}",
      geometry.within_a_day ? "tests of " : "the newest test of each plane: ", dates_of(files, geometry.tests));
  for (const PlaneSquareness& plane : geometry.squareness) {
    texts.rows.push_back({fmt::format("squareness {}", name_of(plane.plane)), with_sigma(plane.value, plane.sigma, 1),
                          dates_of(files, plane.tests)});
  }
  for (const AxisScale& scale : geometry.scales) {
    std::string planes;
    for (const ScalePull& pull : geometry.pulls) {
      const std::string plane(name_of(files.tests[pull.test].plane));
      if (pull.axis != scale.axis || planes.find(plane) != std::string::npos) continue;
      planes += (planes.empty() ? "" : ", ") + plane;
    }
    texts.rows.push_back(
        {fmt::format("scale {}", axis_name(scale.axis)), with_sigma(scale.value_ppm, scale.sigma_ppm, 1), planes});
  }
  texts.sentences = sentences_of(files, geometry);
  return texts;
}

std::string geometry_text(const TestFiles& files, const MachineGeometry& geometry) {
  const GeometryTexts texts = geometry_texts(files, geometry);
  if (texts.rows.empty()) return "";
  Table table({"", "um/m", "from"});
  for (const std::vector<std::string>& row : texts.rows) table.add(row);
  std::string text = texts.heading + '\n' + table.text();
  for (const std::string& sentence : texts.sentences) text += wrapped(sentence);
  return text + '\n';
}

}  // namespace ballbar

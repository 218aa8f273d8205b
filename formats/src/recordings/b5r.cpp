#include "ballbar/formats/recordings/b5r.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/recordings/stored_errors.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/units.hpp"
#include "recordings/b5r_parts.hpp"
#include "text/head.hpp"
#include "text/readers.hpp"
#include "text/xml_source.hpp"

namespace ballbar {
namespace {

// Of two axes' names; nothing where they are none of a plane.
std::optional<Plane> plane_called(std::string_view name) {
  const auto* const found =
      std::find_if(kPlanes.begin(), kPlanes.end(), [&](Plane plane) { return name_of(plane) == name; });
  return found == kPlanes.end() ? std::nullopt : std::optional(*found);
}

// The axes' names decide which is first: TEST_PLANE may say XZ or ZX of the same axes.
Plane plane_of(const SourceText& text, pugi::xml_node ballbar, B5rRemarks& remarks) {
  const pugi::xml_node node = child_of(text, ballbar, "PLANE");
  const std::string_view name = node.attribute("TEST_PLANE").value();
  const std::optional<Plane> stated = plane_called(name);
  if (!stated) {
    fail_at(text, offset_of(node),
            fmt::format("expected a PLANE with TEST_PLANE XY, YZ or ZX, or YX, ZY or XZ, found {}.", in_quotes(name)));
  }
  const Text a = text_of(text, child_of(text, node, "A_AXIS_NAME"));
  const Text b = text_of(text, child_of(text, node, "B_AXIS_NAME"));
  if (a.value == name.substr(0, 1) && b.value == name.substr(1)) return *stated;
  if (a.value == name.substr(1) && b.value == name.substr(0, 1)) {
    const std::string axes = fmt::format("{}{}", a.value, b.value);
    remarks.add(
        a.offset,
        fmt::format("expected the axes {} and {} of the plane {}, found {} first. The file is read as the plane {}.",
                    name[0], name[1], name, a.value, axes));
    return *plane_called(axes);
  }
  const bool of_a = a.value != name.substr(0, 1);
  const Text& found = of_a ? a : b;
  fail_at(text, found.offset,
          fmt::format("expected {} {} for the plane {}, found {}.", of_a ? "A_AXIS_NAME" : "B_AXIS_NAME",
                      of_a ? name[0] : name[1], name, in_quotes(found.value)));
}

void add_features(const SourceText& text, pugi::xml_node node, const std::string& parent,
                  std::vector<StoredFeature>& stored) {
  for (const pugi::xml_node feature : node.children("FEATURE")) {
    StoredFeature one{parent, feature.attribute("NAME").value(), feature.attribute("DT").value()};
    if (one.name.empty() || one.data_type.empty()) {
      fail_at(text, offset_of(feature), "expected a FEATURE with NAME and DT, found one without.");
    }
    one.valid = std::string_view(feature.attribute("VALID").value()) != "False";
    one.status = feature.attribute("STATUS").value();
    const Text found = text_of(text, feature);
    // A value marked as not valid may be missing.
    if (one.valid || !found.value.empty()) one.value = number_of(text, found, one.name);
    stored.push_back(std::move(one));
  }
}

// Lengths from the readings `first` to `last` inclusive.
std::vector<double> lengths_of(const SourceText& text, const Text& readings, std::size_t first, std::size_t last,
                               double nominal_mm) {
  std::vector<double> length_mm;
  length_mm.reserve(std::min(last - first, readings.value.size() / 2) + 1);  // a reading has a digit and a blank
  std::size_t at = 0;
  const std::size_t count = each_number(text, readings, "a reading", [&](double reading_mm, const Text& reading) {
    const double length = nominal_mm + reading_mm;
    if (!(length > 0.0) || !std::isfinite(length)) {
      fail_at(text, reading.offset,
              fmt::format("expected a reading that leaves a length above 0 mm, found {}.", in_quotes(reading.value)));
    }
    if (at >= first && at <= last) length_mm.push_back(length);
    ++at;
  });
  if (last >= count) {
    fail_at(text, readings.offset,
            fmt::format("expected readings up to END_INDEX {}, found {} readings, counted from 0.", last, count));
  }
  return length_mm;
}

// START_ANGLE or END_ANGLE.
std::optional<double> stated_angle(const SourceText& text, pugi::xml_node ballbar, const char* name) {
  const Text found = text_of(text, child_of(text, ballbar, name, false));
  if (found.value.empty() || found.value == "-") return std::nullopt;
  return angle_in(text, ballbar, name);
}

// What all recordings of a test share.
struct TestArc {
  Recording recording;
  double start_deg = 0.0;
  double arc_deg = 360.0;
};

// Needed only where there are readings, which lie on that arc.
TestArc arc_of(const SourceText& text, pugi::xml_node ballbar, const B5r& test) {
  for (const auto& [angle, name] : {std::pair(test.start_deg, "START_ANGLE"), std::pair(test.end_deg, "END_ANGLE")}) {
    if (angle) continue;
    const pugi::xml_node node = ballbar.child(name);
    fail_at(text, offset_of(node ? node : ballbar),
            fmt::format("expected START_ANGLE and END_ANGLE, the arc of the readings in deg, found no {}.", name));
  }
  TestArc arc;
  arc.recording.nominal_length_mm = test.nominal_length_mm;
  arc.recording.plane = test.plane;
  arc.recording.started_s = test.started_s;
  arc.start_deg = *test.start_deg;
  arc.arc_deg = std::fmod(*test.end_deg - arc.start_deg, 360.0);
  if (arc.arc_deg <= 0.0) arc.arc_deg += 360.0;
  return arc;
}

std::optional<Direction> direction_of(const SourceText& text, pugi::xml_node run, bool needed) {
  const Text direction = text_of(text, child_of(text, run, "RUN_DIRECTION", needed));
  if (direction.value == "CCW") return Direction::CCW;
  if (direction.value == "CW") return Direction::CW;
  if (direction.value.empty() && !needed) return std::nullopt;
  fail_at(text, direction.offset,
          fmt::format("expected RUN_DIRECTION CCW or CW, found {}.", in_quotes(direction.value)));
}

Recording recording_of(const SourceText& text, pugi::xml_node run, const Text& readings, Direction direction,
                       const TestArc& arc) {
  Recording recording = arc.recording;
  const bool ccw = direction == Direction::CCW;
  recording.direction = direction;
  recording.bar_temperature_degC = stated_number(text, run, "RUN_TEMPERATURE");
  const std::size_t first = index_in(text, run, "START_INDEX");
  const std::size_t last = index_in(text, run, "END_INDEX");
  if (first > last) {
    fail_at(text, offset_of(run.child("END_INDEX")),
            fmt::format("expected END_INDEX at or above START_INDEX {}, found {}.", first, last));
  }
  const double sample_rate_Hz = positive_in(text, run, "SAMPLE_RATE");
  recording.length_mm = lengths_of(text, readings, first, last, recording.nominal_length_mm);
  recording.angle_rad.reserve(recording.length_mm.size());
  const auto n = static_cast<double>(recording.length_mm.size());
  for (double i = 0.5; i < n; ++i) {
    const double travelled_deg = i * arc.arc_deg / n;
    recording.angle_rad.push_back(rad_from_deg(arc.start_deg + (ccw ? travelled_deg : arc.arc_deg - travelled_deg)));
  }
  recording.feed_mm_per_min =
      2.0 * kPi * recording.nominal_length_mm * (arc.arc_deg / 360.0) * sample_rate_Hz / n * 60.0;
  return recording;
}

std::string_view direction_phrase(const StoredRun& run) { return run.direction ? name_of(*run.direction) : "a"; }

// A run without readings, one that misses, or both of one direction.
void remark_runs(const std::vector<pugi::xml_node>& nodes, pugi::xml_node place, const B5r& test, B5rRemarks& remarks) {
  if (test.runs.empty()) {
    remarks.add(offset_of(place), "No readings in this file; showing the results stored by the instrument software.");
    return;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (test.run_results[i].recording) continue;
    remarks.add(offset_of(nodes[i]),
                fmt::format("No readings in the {} run; showing the results stored by the instrument software.",
                            direction_phrase(test.run_results[i])));
  }
  const std::string_view direction = name_of(test.runs.front().direction);
  if (nodes.size() == 1) {
    remarks.add(offset_of(place), fmt::format("expected a CCW and a CW run, found one {} run.", direction));
  } else if (nodes.size() == 2 && test.runs.size() == 2 && test.runs[0].direction == test.runs[1].direction) {
    remarks.add(offset_of(nodes[1]), fmt::format("expected a CCW and a CW run, found two {} runs.", direction));
  }
}

void read_runs(const SourceText& text, pugi::xml_node document, pugi::xml_node ballbar, B5r& test,
               B5rRemarks& remarks) {
  const pugi::xml_node results = child_of(text, document, "RUN_RESULTS", false);
  std::vector<pugi::xml_node> nodes;
  std::optional<TestArc> arc;
  for (const pugi::xml_node run : results.children("BALLBAR_RUN")) {
    StoredRun stored;
    stored.parent = fmt::format("run {}", nodes.size());
    nodes.push_back(run);
    const Text readings = text_of(text, child_of(text, run, "READINGS", false));
    stored.direction = direction_of(text, run, !readings.value.empty());
    if (!readings.value.empty()) {
      if (!arc) arc = arc_of(text, ballbar, test);
      stored.recording = test.runs.size();
      test.runs.push_back(recording_of(text, run, readings, *stored.direction, *arc));
    }
    add_features(text, run, stored.parent, test.stored);
    test.run_results.push_back(std::move(stored));
  }
  for (const pugi::xml_node analysis : document.children("ANALYSIS")) {
    add_features(text, analysis, analysis_name(analysis), test.stored);
  }
  if (test.runs.empty() && test.stored.empty()) {
    fail_at(text, offset_of(results ? results : document), "expected READINGS or stored results, found neither.");
  }
  remark_runs(nodes, results ? results : document, test, remarks);
}

RecordingFile b5r_file(std::string_view bytes, std::string_view name) {
  if (bytes.size() > kLargestText) {
    throw Error(fmt::format("{}: expected at most {} MiB of XML, found a larger file.", name, kLargestText >> 20));
  }
  RecordingFile file;
  file.b5r = read_b5r(bytes, name);
  file.recordings = std::exchange(file.b5r->runs, {});
  for (Recording& recording : file.recordings) {
    recording.pitch_a_mm = stored_pitch_mm(*file.b5r, 'A');
    recording.pitch_b_mm = stored_pitch_mm(*file.b5r, 'B');
  }
  file.remarks = std::exchange(file.b5r->remarks, {});
  return file;
}

constexpr std::string_view kRoot = "TEST_DOCUMENT";
constexpr std::string_view kFound = "XML, such as a .b5r file";

}  // namespace

constinit const Reader readers::kB5r = {
    .found = kFound,
    .recording = "a Renishaw .b5r file (XML)",
    .is_yours = [](std::string_view head) { return xml_root(head) == kRoot; },
    .read = b5r_file,
};

// That no reader knows; read_b5r says what it is not.
constinit const Reader readers::kOtherXml = {
    .found = kFound,
    .is_yours = [](std::string_view head) { return text_of_head(head).starts_with('<'); },
    .read = b5r_file,
};

B5r read_b5r(std::string_view bytes, std::string_view name) {
  std::string utf8;
  if (is_utf16(bytes)) {
    utf8 = utf8_from_utf16(bytes);
    bytes = utf8;
  }
  const SourceText text = source_text(bytes, name);
  pugi::xml_document file;
  parse_xml(text, file);
  const pugi::xml_node document = file.document_element();
  if (document.name() != kRoot) {
    fail_at(text, offset_of(document),
            fmt::format("expected {}, the root of a .b5r file, found {}.", kRoot, in_quotes(document.name())));
  }
  const pugi::xml_node test = child_of(text, document, "TEST_SPEC");
  const pugi::xml_node ballbar = child_of(text, child_of(text, test, "INSTRUMENT"), "DYNAMIC_BALLBAR");
  B5r b5r;
  B5rRemarks remarks(text, b5r.remarks);
  b5r.test_name = test.attribute("NAME").value();
  b5r.nominal_length_mm = positive_in(text, ballbar, "NOMINAL_LENGTH");
  b5r.start_deg = stated_angle(text, ballbar, "START_ANGLE");
  b5r.end_deg = stated_angle(text, ballbar, "END_ANGLE");
  b5r.plane = plane_of(text, ballbar, remarks);
  read_head(text, document, b5r, remarks);
  read_limits(text, test, b5r, remarks);
  read_runs(text, document, ballbar, b5r, remarks);
  read_curves(text, document, b5r, remarks);
  return b5r;
}

std::optional<double> stored_value(const B5r& test, std::string_view parent, std::string_view name,
                                   std::string_view data_type) {
  for (const StoredFeature& stored : test.stored) {
    if (stored.valid && stored.parent == parent && stored.name == name && stored.data_type == data_type)
      return stored.value;
  }
  return std::nullopt;
}

std::string parent_of(const B5r& test, std::size_t recording) {
  for (const StoredRun& run : test.run_results) {
    if (run.recording == recording) return run.parent;
  }
  return fmt::format("run {}", recording);
}

}  // namespace ballbar

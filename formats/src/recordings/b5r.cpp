#include "ballbar/formats/recordings/b5r.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/units.hpp"
#include "text/head.hpp"
#include "text/readers.hpp"
#include "text/xml_source.hpp"

namespace ballbar {
namespace {

// YYYYMMDD-HHMMSS on the machine's own clock.
std::optional<std::int64_t> started_s(const SourceText& text, pugi::xml_node document) {
  const pugi::xml_node node = child_of(text, document, "DATE_STARTED", false);
  if (!node) return std::nullopt;
  const Text found = text_of(text, node);
  if (found.value.empty() || found.value == "-") return std::nullopt;
  const auto part = [&](std::size_t at, std::size_t digits) {
    int value = 0;
    for (const char c : found.value.substr(at, digits)) value = c >= '0' && c <= '9' ? value * 10 + (c - '0') : 1000000;
    return value;
  };
  if (found.value.size() == 15 && found.value[8] == '-') {
    const auto date = std::chrono::year(part(0, 4)) / part(4, 2) / part(6, 2);
    if (date.ok() && part(9, 2) < 24 && part(11, 2) < 60 && part(13, 2) < 60) {
      const std::chrono::seconds day = std::chrono::sys_days(date).time_since_epoch();
      return day.count() + part(9, 2) * 3600 + part(11, 2) * 60 + part(13, 2);
    }
  }
  fail_at(text, found.offset,
          fmt::format("expected a date as YYYYMMDD-HHMMSS for DATE_STARTED, found {}.", in_quotes(found.value)));
}

Plane plane_of(const SourceText& text, pugi::xml_node ballbar) {
  const pugi::xml_node node = child_of(text, ballbar, "PLANE");
  const std::string_view name = node.attribute("TEST_PLANE").value();
  constexpr std::string_view kAxes[] = {"X", "Y", "Z"};
  for (const Plane plane : {Plane::XY, Plane::YZ, Plane::ZX}) {
    if (name != name_of(plane)) continue;
    const std::pair<const char*, int> axes[] = {{"A_AXIS_NAME", axes_of(plane)[0]}, {"B_AXIS_NAME", axes_of(plane)[1]}};
    for (const auto& [element, axis] : axes) {
      const Text found = text_of(text, child_of(text, node, element));
      if (found.value == kAxes[axis]) continue;
      fail_at(text, found.offset,
              fmt::format("expected {} {} for the plane {}, found {}.", element, kAxes[axis], name,
                          in_quotes(found.value)));
    }
    return plane;
  }
  fail_at(text, offset_of(node),
          fmt::format("expected a PLANE with TEST_PLANE XY, YZ or ZX, found {}.", in_quotes(name)));
}

std::vector<StoredFeature> features_of(const SourceText& text, pugi::xml_node node, const std::string& parent) {
  std::vector<StoredFeature> features;
  for (const pugi::xml_node feature : node.children("FEATURE")) {
    StoredFeature stored{parent, feature.attribute("NAME").value(), feature.attribute("DT").value()};
    if (stored.name.empty() || stored.data_type.empty()) {
      fail_at(text, offset_of(feature), "expected a FEATURE with NAME and DT, found one without.");
    }
    stored.valid = std::string_view(feature.attribute("VALID").value()) != "False";
    const Text found = text_of(text, feature);
    // A value marked as not valid may be missing.
    if (stored.valid || !found.value.empty()) stored.value = number_of(text, found, stored.name);
    features.push_back(std::move(stored));
  }
  return features;
}

// Lengths from the readings `first` to `last` inclusive.
std::vector<double> lengths_of(const SourceText& text, const Text& readings, std::size_t first, std::size_t last,
                               double nominal_mm) {
  std::vector<double> length_mm;
  std::size_t count = 0;
  std::size_t at = 0;
  while (at < readings.value.size()) {
    const std::size_t end = std::min(readings.value.find_first_of(kBlank, at), readings.value.size());
    const Text reading{readings.value.substr(at, end - at), readings.offset + at};
    const double length = nominal_mm + number_of(text, reading, "a reading");
    if (!(length > 0.0) || !std::isfinite(length)) {
      fail_at(text, reading.offset,
              fmt::format("expected a reading that leaves a length above 0 mm, found {}.", in_quotes(reading.value)));
    }
    if (count >= first && count <= last) length_mm.push_back(length);
    ++count;
    at = std::min(readings.value.find_first_not_of(kBlank, end), readings.value.size());
  }
  if (last >= count) {
    fail_at(text, readings.offset,
            fmt::format("expected readings up to END_INDEX {}, found {} readings, counted from 0.", last, count));
  }
  return length_mm;
}

// What all runs of a test share.
struct TestSpec {
  Recording recording;
  double start_deg = 0.0;
  double arc_deg = 360.0;
};

TestSpec test_spec(const SourceText& text, pugi::xml_node document, pugi::xml_node ballbar) {
  TestSpec spec;
  spec.recording.nominal_length_mm = positive_in(text, ballbar, "NOMINAL_LENGTH");
  spec.recording.plane = plane_of(text, ballbar);
  spec.recording.started_s = started_s(text, document);
  spec.start_deg = angle_in(text, ballbar, "START_ANGLE");
  spec.arc_deg = std::fmod(angle_in(text, ballbar, "END_ANGLE") - spec.start_deg, 360.0);
  if (spec.arc_deg <= 0.0) spec.arc_deg += 360.0;
  return spec;
}

Recording run_of(const SourceText& text, pugi::xml_node run, const TestSpec& spec) {
  Recording recording = spec.recording;
  const Text direction = text_of(text, child_of(text, run, "RUN_DIRECTION"));
  if (direction.value != "CCW" && direction.value != "CW") {
    fail_at(text, direction.offset,
            fmt::format("expected RUN_DIRECTION CCW or CW, found {}.", in_quotes(direction.value)));
  }
  const bool ccw = direction.value == "CCW";
  recording.direction = ccw ? Direction::CCW : Direction::CW;
  recording.bar_temperature_degC = optional_number_in(text, run, "RUN_TEMPERATURE");
  const pugi::xml_node readings = child_of(text, run, "READINGS", false);
  if (!readings || text_of(text, readings).value.empty()) {
    fail_at(
        text, offset_of(run),
        "expected READINGS in BALLBAR_RUN, found none; this file stores results only, and drift needs the readings.");
  }
  const std::size_t first = index_in(text, run, "START_INDEX");
  const std::size_t last = index_in(text, run, "END_INDEX");
  if (first > last) {
    fail_at(text, offset_of(run.child("END_INDEX")),
            fmt::format("expected END_INDEX at or above START_INDEX {}, found {}.", first, last));
  }
  const double sample_rate_Hz = positive_in(text, run, "SAMPLE_RATE");
  recording.length_mm = lengths_of(text, text_of(text, readings), first, last, recording.nominal_length_mm);
  const auto n = static_cast<double>(recording.length_mm.size());
  for (double i = 0.5; i < n; ++i) {
    const double travelled_deg = i * spec.arc_deg / n;
    recording.angle_rad.push_back(rad_from_deg(spec.start_deg + (ccw ? travelled_deg : spec.arc_deg - travelled_deg)));
  }
  recording.feed_mm_per_min =
      2.0 * kPi * recording.nominal_length_mm * (spec.arc_deg / 360.0) * sample_rate_Hz / n * 60.0;
  return recording;
}

RecordingFile b5r_file(std::string_view bytes, std::string_view name) {
  if (bytes.size() > kLargestText) {
    throw Error(fmt::format("{}: expected at most {} MiB of XML, found a larger file.", name, kLargestText >> 20));
  }
  RecordingFile file;
  file.b5r = read_b5r(bytes, name);
  file.recordings = std::exchange(file.b5r->runs, {});
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
  const pugi::xml_node equipment = document.child("EQUIPMENT");
  const auto optional_text = [&](pugi::xml_node node) { return std::string(text_of(text, node).value); };

  B5r b5r;
  b5r.test_name = test.attribute("NAME").value();
  b5r.ballbar_model = optional_text(equipment.child("BALLBAR").child("MODEL"));
  b5r.software_version = optional_text(equipment.child("SOFTWARE").child("VERSION"));
  b5r.programmed_feed_mm_per_min = optional_number_in(text, ballbar, "PROGRAMMED_FEEDRATE");
  const TestSpec spec = test_spec(text, document, ballbar);
  const pugi::xml_node results = child_of(text, document, "RUN_RESULTS");
  const auto keep = [&](std::vector<StoredFeature> features) {
    std::move(features.begin(), features.end(), std::back_inserter(b5r.stored));
  };
  for (const pugi::xml_node run : results.children("BALLBAR_RUN")) {
    keep(features_of(text, run, fmt::format("run {}", b5r.runs.size())));
    b5r.runs.push_back(run_of(text, run, spec));
  }
  if (b5r.runs.empty()) fail_at(text, offset_of(results), "expected a BALLBAR_RUN in RUN_RESULTS, found none.");
  for (const pugi::xml_node analysis : document.children("ANALYSIS")) {
    const std::string_view version = analysis.attribute("version").value();
    keep(features_of(text, analysis,
                     fmt::format("{}{}{}", analysis.attribute("NAME").value(), version.empty() ? "" : " ", version)));
  }
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

}  // namespace ballbar

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/units.hpp"
#include "recordings/b5r_date.hpp"
#include "recordings/b5r_parts.hpp"

namespace ballbar {
namespace {

using Out = std::back_insert_iterator<fmt::memory_buffer>;

// START_ANGLE and END_ANGLE, deg, in [0, 360), counter-clockwise; equal for a full circle.
struct Sweep_deg {
  double start = 0.0;
  double arc = 360.0;
  double end = 0.0;
};

// Of n readings over that arc at the recording's feed.
double sample_rate_Hz(const Recording& run, double arc_deg) {
  const double path_mm = 2.0 * kPi * run.nominal_length_mm * (arc_deg / 360.0);
  return *run.feed_mm_per_min / 60.0 * static_cast<double>(run.length_mm.size()) / path_mm;
}

// Text as it stands in XML.
std::string escaped(std::string_view text) {
  constexpr std::pair<char, std::string_view> kEntities[] = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string result;
  for (const char c : text) {
    const auto* entity =
        std::find_if(std::begin(kEntities), std::end(kEntities), [&](const auto& one) { return one.first == c; });
    if (entity != std::end(kEntities)) {
      result += entity->second;
    } else {  // XML 1.0 has no other control characters, not even escaped.
      result += static_cast<unsigned char>(c) < 0x20 && c != '\t' ? ' ' : c;
    }
  }
  return result;
}

// "ISO230_4 2005" as NAME="ISO230_4" version="2005".
std::string analysis_attributes(std::string_view parent) {
  const std::size_t space = parent.find(' ');
  std::string text = fmt::format("NAME=\"{}\"", escaped(parent.substr(0, space)));
  if (space != std::string_view::npos) text += fmt::format(" version=\"{}\"", escaped(parent.substr(space + 1)));
  return text;
}

// Seven decimals are far below a reading's own place and turn 179.99999999999997 into 180.
double rounded_deg(double angle_deg) {
  const double rounded = std::round(angle_deg * 1e7) / 1e7;
  return rounded - 360.0 * std::floor(rounded / 360.0);
}

Sweep_deg sweep_of(const Recording& run) {
  const auto n = static_cast<double>(run.angle_rad.size());
  const double first = run.direction == Direction::CCW ? run.angle_rad.front() : run.angle_rad.back();
  const double last = run.direction == Direction::CCW ? run.angle_rad.back() : run.angle_rad.front();
  const double step_rad = (last - first) / (n - 1.0);
  Sweep_deg sweep;
  sweep.start = rounded_deg(deg_from_rad(first - 0.5 * step_rad));
  sweep.end = rounded_deg(deg_from_rad(last + 0.5 * step_rad));
  sweep.arc = sweep.end - sweep.start;
  if (sweep.arc <= 0.0) sweep.arc += 360.0;
  return sweep;
}

void expect_writable(const B5r& test) {
  if (test.runs.empty() && test.run_results.empty() && test.stored.empty()) {
    throw Error("a .b5r file is written from at least one run or stored result, found none.");
  }
  for (const StoredRun& run : test.run_results) {
    if (run.recording && *run.recording >= test.runs.size()) {
      throw Error("the run_results of a .b5r file name its recordings, found one that is not there.");
    }
  }
  for (const SimulatedCurve& curve : test.simulated_um) {
    const auto run = std::find_if(test.runs.begin(), test.runs.end(),
                                  [&](const Recording& one) { return one.direction == curve.direction; });
    if (run != test.runs.end() && run->length_mm.size() == curve.deviation_um.size()) continue;
    throw Error("a .b5r file has simulated curves as long as its runs of that direction, found another.");
  }
  if (test.runs.empty()) return;
  const Recording& first = test.runs.front();
  for (const Recording& run : test.runs) {
    if (run.kind != Kind::circle || run.angle_rad.size() < 2 || run.angle_rad.size() != run.length_mm.size()) {
      throw Error("a .b5r file is written from circles of at least two readings, found another recording.");
    }
    if (!run.started_s || !run.feed_mm_per_min) {
      throw Error("a .b5r file states when a run started and its feed, found a run without.");
    }
    const Sweep_deg sweep = sweep_of(run);
    const Sweep_deg common = sweep_of(first);
    if (run.plane != first.plane || run.nominal_length_mm != first.nominal_length_mm ||
        std::abs(sweep.start - common.start) > 1e-6 || std::abs(sweep.end - common.end) > 1e-6) {
      throw Error("the runs of a .b5r file share plane, nominal length, start and end angle, found runs that differ.");
    }
  }
}

void write_feature(Out to, const StoredFeature& feature) {
  fmt::format_to(to, "      <FEATURE NAME=\"{}\" DT=\"{}\"{}{}>{}</FEATURE>\n", escaped(feature.name),
                 escaped(feature.data_type), feature.valid ? "" : " VALID=\"False\"",
                 feature.status.empty() ? "" : fmt::format(" STATUS=\"{}\"", escaped(feature.status)), feature.value);
}

void write_readings(Out to, const Recording& run, double arc_deg, std::size_t overshoot) {
  const std::size_t n = run.length_mm.size();
  if (run.bar_temperature_degC) {
    fmt::format_to(to, "      <RUN_TEMPERATURE>{}</RUN_TEMPERATURE>\n", *run.bar_temperature_degC);
  }
  fmt::format_to(to,
                 "      <START_INDEX>{}</START_INDEX>\n      <END_INDEX>{}</END_INDEX>\n"
                 "      <SAMPLE_RATE>{}</SAMPLE_RATE>\n      <READINGS>",
                 overshoot, overshoot + n - 1, sample_rate_Hz(run, arc_deg));
  for (std::size_t i = 0; i < n + 2 * overshoot; ++i) {
    const std::size_t reading = i < overshoot ? 0 : i - overshoot < n ? i - overshoot : n - 1;
    fmt::format_to(to, "{}{:+.5f}", i == 0 ? "" : " ", run.length_mm[reading] - run.nominal_length_mm);
  }
  fmt::format_to(to, "</READINGS>\n");
}

// As the file had them; of a test made by hand the recordings alone.
std::vector<StoredRun> all_runs(const B5r& test) {
  if (!test.run_results.empty()) return test.run_results;
  std::vector<StoredRun> runs;
  runs.reserve(test.runs.size());
  for (std::size_t i = 0; i < test.runs.size(); ++i) {
    runs.push_back({fmt::format("run {}", i), test.runs[i].direction, i});
  }
  return runs;
}

void write_run(Out to, const B5r& test, const StoredRun& run, const Sweep_deg& sweep, std::size_t overshoot) {
  const Recording* const recording = run.recording ? &test.runs.at(*run.recording) : nullptr;
  const std::optional<Direction> direction = recording ? recording->direction : run.direction;
  fmt::format_to(to, "    <BALLBAR_RUN>\n");
  if (direction) fmt::format_to(to, "      <RUN_DIRECTION>{}</RUN_DIRECTION>\n", name_of(*direction));
  if (recording) write_readings(to, *recording, sweep.arc, overshoot);
  for (const StoredFeature& feature : test.stored) {
    if (feature.parent == run.parent) write_feature(to, feature);
  }
  fmt::format_to(to, "    </BALLBAR_RUN>\n");
}

void write_curves(Out to, const B5r& test) {
  for (const SimulatedCurve& curve : test.simulated_um) {
    fmt::format_to(to, "      <SIMULATION NAME=\"AF_SIMULATED_READINGS_{}\">", name_of(curve.direction));
    for (std::size_t i = 0; i < curve.deviation_um.size(); ++i) {
      fmt::format_to(to, "{}{:.5f}", i == 0 ? "" : " ", mm_from_um(curve.deviation_um[i]));
    }
    fmt::format_to(to, "</SIMULATION>\n");
  }
}

// One ANALYSIS for each stretch of features with the same parent; the curves in the first that may have them.
void write_analyses(Out to, const B5r& test) {
  bool curves = !test.simulated_um.empty();
  std::string_view open;
  const auto close = [&] {
    if (open.empty()) return;
    if (curves && open.substr(0, open.find(' ')) == kCurveAnalysis) {
      write_curves(to, test);
      curves = false;
    }
    fmt::format_to(to, "  </ANALYSIS>\n");
  };
  for (const StoredFeature& feature : test.stored) {
    if (feature.parent.starts_with("run ")) continue;
    if (feature.parent != open) {
      close();
      open = feature.parent;
      fmt::format_to(to, "  <ANALYSIS {}>\n", analysis_attributes(open));
    }
    write_feature(to, feature);
  }
  close();
  if (!curves) return;
  fmt::format_to(to, "  <ANALYSIS NAME=\"{}\">\n", kCurveAnalysis);
  write_curves(to, test);
  fmt::format_to(to, "  </ANALYSIS>\n");
}

// An element with what it holds; none where that is not stated.
void write_element(Out to, int indent, std::string_view name, const std::string& text) {
  if (!text.empty()) fmt::format_to(to, "{:{}}<{}>{}</{}>\n", "", indent, name, escaped(text), name);
}

void write_element(Out to, int indent, std::string_view name, const std::optional<double>& value) {
  if (value) fmt::format_to(to, "{:{}}<{}>{}</{}>\n", "", indent, name, *value, name);
}

// The limits of one parent, a FEATURE_SPEC each.
void write_limits(Out to, int indent, const B5r& test, std::string_view parent) {
  for (const Limit& limit : test.limits) {
    if (limit.parent != parent) continue;
    fmt::format_to(to, "{:{}}<FEATURE_SPEC NAME=\"{}\" DT=\"{}\">\n", "", indent, escaped(limit.name),
                   escaped(limit.data_type));
    fmt::format_to(to, "{:{}}<TOLERANCE LEVEL=\"{}\">\n", "", indent + 2, escaped(limit.level));
    write_element(to, indent + 4, "LOWER_LIMIT", limit.lower);
    write_element(to, indent + 4, "UPPER_LIMIT", limit.upper);
    fmt::format_to(to, "{0:{1}}</TOLERANCE>\n{0:{2}}</FEATURE_SPEC>\n", "", indent + 2, indent);
  }
}

void write_analysis_limits(Out to, const B5r& test) {
  std::vector<std::string_view> parents;
  for (const Limit& limit : test.limits) {
    if (limit.parent == "RUN_SPEC" || limit.parent == "TEST_SPEC") continue;
    if (std::find(parents.begin(), parents.end(), limit.parent) != parents.end()) continue;
    parents.push_back(limit.parent);
    fmt::format_to(to, "    <ANALYSIS_SPEC {}>\n", analysis_attributes(limit.parent));
    write_limits(to, 6, test, limit.parent);
    fmt::format_to(to, "    </ANALYSIS_SPEC>\n");
  }
}

// As the instrument writes it, where it is a date.
std::string written_day(const std::string& day) {
  const std::optional<std::int64_t> read = date_s(day);
  return read ? stored_date(*read).substr(0, 8) : day;
}

// TEST_SPEC; `sweep` is that of the recordings, where there are any; without runs from the test itself.
void write_spec(Out to, const B5r& test, const Sweep_deg& sweep) {
  const Recording* const run = test.runs.empty() ? nullptr : &test.runs.front();
  const std::string_view plane = name_of(run ? run->plane : test.plane);
  const double nominal_length_mm = run ? run->nominal_length_mm : test.nominal_length_mm;
  fmt::format_to(to,
                 "  <TEST_SPEC NAME=\"{}\" version=\"2.0\">\n"
                 "    <INSTRUMENT MANUFACTURER=\"Renishaw\" MODEL=\"{}\">\n"
                 "      <DYNAMIC_BALLBAR>\n"
                 "        <NOMINAL_LENGTH>{}</NOMINAL_LENGTH>\n",
                 escaped(test.test_name), escaped(test.ballbar_model), nominal_length_mm);
  write_element(to, 8, "PROGRAMMED_FEEDRATE",
                run && !test.programmed_feed_mm_per_min ? run->feed_mm_per_min : test.programmed_feed_mm_per_min);
  write_element(to, 8, "START_ANGLE", run ? sweep.start : test.start_deg);
  write_element(to, 8, "END_ANGLE", run ? sweep.end : test.end_deg);
  write_element(to, 8, "OVERSHOOT_ANGLE", test.overshoot_deg);
  fmt::format_to(to,
                 "        <TEST_RADIUS>{}</TEST_RADIUS>\n"
                 "        <PLANE VIEW=\"+A+B\" TEST_PLANE=\"{}\">\n"
                 "          <A_AXIS_NAME>{}</A_AXIS_NAME>\n"
                 "          <B_AXIS_NAME>{}</B_AXIS_NAME>\n"
                 "        </PLANE>\n",
                 test.test_radius_mm.value_or(nominal_length_mm), plane, plane[0], plane[1]);
  if (std::any_of(test.limits.begin(), test.limits.end(), [](const Limit& one) { return one.parent == "RUN_SPEC"; })) {
    fmt::format_to(to, "        <RUN_SPEC>\n");
    write_limits(to, 10, test, "RUN_SPEC");
    fmt::format_to(to, "        </RUN_SPEC>\n");
  }
  write_element(to, 8, "SPINDLE_NUMBER", test.spindle_number);
  if (run) fmt::format_to(to, "        <SAMPLE_RATE>{}</SAMPLE_RATE>\n", sample_rate_Hz(*run, sweep.arc));
  write_element(to, 8, "NC_PROGRAM_ID", test.nc_program);
  write_element(to, 8, "TEMP_MATERIAL_COEFFICIENT", test.material_expansion_ppm_per_K);
  fmt::format_to(to, "      </DYNAMIC_BALLBAR>\n    </INSTRUMENT>\n");
  write_analysis_limits(to, test);
  write_limits(to, 4, test, "TEST_SPEC");
  fmt::format_to(to, "  </TEST_SPEC>\n");
}

// From OPERATOR to EQUIPMENT.
void write_head(Out to, const B5r& test) {
  const std::optional<std::int64_t> started_s = test.runs.empty() ? test.started_s : test.runs.front().started_s;
  const auto date = [](const std::optional<std::int64_t>& at) { return at ? stored_date(*at) : std::string(); };
  write_element(to, 2, "OPERATOR", test.operator_name);
  if (!test.comment.empty()) {
    fmt::format_to(to, "  <COMMENT NAME=\"PRE_TEST_COMMENT\">{}</COMMENT>\n", escaped(test.comment));
  }
  write_element(to, 2, "DATE_STARTED", date(started_s));
  write_element(to, 2, "DATE_COMPLETED", date(test.completed_s));
  if (!test.machine.empty()) fmt::format_to(to, "  <MACHINE_TESTED NAME=\"{}\" />\n", escaped(test.machine));
  fmt::format_to(to, "  <EQUIPMENT>\n    <BALLBAR>\n      <MODEL>{}</MODEL>\n", escaped(test.ballbar_model));
  write_element(to, 6, "SERIAL_NUMBER", test.serial_number);
  write_element(to, 6, "SCALE_FACTOR", test.scale_factor);
  write_element(to, 6, "CERTIFICATE_NUMBER", test.certificate);
  write_element(to, 6, "LAST_CALIBRATED", written_day(test.last_calibrated));
  fmt::format_to(to, "    </BALLBAR>\n");
  const Calibrator& calibrator = test.calibrator;
  fmt::memory_buffer inside;
  const Out in = std::back_inserter(inside);
  write_element(in, 6, "MODEL", calibrator.model);
  write_element(in, 6, "SERIAL_NUMBER", calibrator.serial_number);
  write_element(in, 6, "EXPANSION_COEFFICIENT", calibrator.expansion_ppm_per_K);
  write_element(in, 6, "CALIBRATED_LENGTH", calibrator.calibrated_length_mm);
  write_element(in, 6, "TEMPERATURE", calibrator.temperature_degC);
  write_element(in, 6, "CERTIFICATE_NUMBER", calibrator.certificate);
  write_element(in, 6, "LAST_CALIBRATED", written_day(calibrator.last_calibrated));
  if (inside.size() > 0) fmt::format_to(to, "    <CALIBRATOR>\n{}    </CALIBRATOR>\n", fmt::to_string(inside));
  fmt::format_to(to, "    <SOFTWARE>\n");
  write_element(to, 6, "TITLE", test.software_title);
  fmt::format_to(to, "      <VERSION>{}</VERSION>\n    </SOFTWARE>\n  </EQUIPMENT>\n", escaped(test.software_version));
}

}  // namespace

std::string write_b5r(const B5r& test, std::size_t overshoot_readings) {
  expect_writable(test);
  const Sweep_deg sweep = test.runs.empty() ? Sweep_deg() : sweep_of(test.runs.front());
  fmt::memory_buffer out;
  const Out to = std::back_inserter(out);
  fmt::format_to(to, "\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"utf-8\" standalone=\"yes\"?>\n<TEST_DOCUMENT>\n");
  write_spec(to, test, sweep);
  write_head(to, test);
  fmt::format_to(to, "  <RUN_RESULTS>\n");
  for (const StoredRun& run : all_runs(test)) write_run(to, test, run, sweep, overshoot_readings);
  fmt::format_to(to, "  </RUN_RESULTS>\n");
  write_analyses(to, test);
  fmt::format_to(to, "</TEST_DOCUMENT>\n");
  return fmt::to_string(out);
}

}  // namespace ballbar

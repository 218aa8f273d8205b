// What stands before the runs of a written `.b5r`.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "ballbar/units.hpp"
#include "recordings/b5r_date.hpp"
#include "recordings/b5r_written.hpp"

namespace ballbar {
namespace {

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

}  // namespace

double sample_rate_Hz(const Recording& run, double arc_deg) {
  const double path_mm = 2.0 * kPi * run.nominal_length_mm * (arc_deg / 360.0);
  return *run.feed_mm_per_min / 60.0 * static_cast<double>(run.length_mm.size()) / path_mm;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        // XML 1.0 has no other control characters, not even escaped.
        result += static_cast<unsigned char>(c) < 0x20 && c != '\t' ? ' ' : c;
    }
  }
  return result;
}

std::string analysis_attributes(std::string_view parent) {
  const std::size_t space = parent.find(' ');
  std::string text = fmt::format("NAME=\"{}\"", escaped(parent.substr(0, space)));
  if (space != std::string_view::npos) text += fmt::format(" version=\"{}\"", escaped(parent.substr(space + 1)));
  return text;
}

// Without runs from the test itself.
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

}  // namespace ballbar

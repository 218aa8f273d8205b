#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

using Out = std::back_insert_iterator<fmt::memory_buffer>;

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

// START_ANGLE and END_ANGLE, deg, in [0, 360), counter-clockwise; equal for a full circle.
struct Sweep_deg {
  double start = 0.0;
  double arc = 360.0;
  double end = 0.0;
};

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
  if (test.runs.empty()) throw Error("a .b5r file is written from at least one run, found none.");
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

std::string date(std::int64_t local_time_s) {
  const std::chrono::sys_seconds time{std::chrono::seconds(local_time_s)};
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day ymd(day);
  const std::chrono::hh_mm_ss clock(time - day);
  return fmt::format("{:04}{:02}{:02}-{:02}{:02}{:02}", static_cast<int>(ymd.year()),
                     static_cast<unsigned>(ymd.month()), static_cast<unsigned>(ymd.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count());
}

double sample_rate_Hz(const Recording& run, double arc_deg) {
  const double path_mm = 2.0 * kPi * run.nominal_length_mm * (arc_deg / 360.0);
  return *run.feed_mm_per_min / 60.0 * static_cast<double>(run.length_mm.size()) / path_mm;
}

void write_spec(Out to, const B5r& test, const Sweep_deg& sweep) {
  const Recording& run = test.runs.front();
  const std::string_view plane = name_of(run.plane);
  fmt::format_to(to,
                 "  <TEST_SPEC NAME=\"{}\" version=\"2.0\">\n"
                 "    <INSTRUMENT MANUFACTURER=\"Renishaw\" MODEL=\"{}\">\n"
                 "      <DYNAMIC_BALLBAR>\n"
                 "        <NOMINAL_LENGTH>{}</NOMINAL_LENGTH>\n"
                 "        <PROGRAMMED_FEEDRATE>{}</PROGRAMMED_FEEDRATE>\n"
                 "        <START_ANGLE>{}</START_ANGLE>\n"
                 "        <END_ANGLE>{}</END_ANGLE>\n",
                 escaped(test.test_name), escaped(test.ballbar_model), run.nominal_length_mm,
                 test.programmed_feed_mm_per_min.value_or(*run.feed_mm_per_min), sweep.start, sweep.end);
  fmt::format_to(to,
                 "        <TEST_RADIUS>{}</TEST_RADIUS>\n"
                 "        <PLANE VIEW=\"+A+B\" TEST_PLANE=\"{}\">\n"
                 "          <A_AXIS_NAME>{}</A_AXIS_NAME>\n"
                 "          <B_AXIS_NAME>{}</B_AXIS_NAME>\n"
                 "        </PLANE>\n"
                 "        <SAMPLE_RATE>{}</SAMPLE_RATE>\n"
                 "      </DYNAMIC_BALLBAR>\n"
                 "    </INSTRUMENT>\n"
                 "  </TEST_SPEC>\n",
                 run.nominal_length_mm, plane, plane[0], plane[1], sample_rate_Hz(run, sweep.arc));
}

void write_feature(Out to, const StoredFeature& feature) {
  fmt::format_to(to, "      <FEATURE NAME=\"{}\" DT=\"{}\"{}>{}</FEATURE>\n", escaped(feature.name),
                 escaped(feature.data_type), feature.valid ? "" : " VALID=\"False\"", feature.value);
}

void write_run(Out to, const B5r& test, std::size_t index, const Sweep_deg& sweep, std::size_t overshoot) {
  const Recording& run = test.runs[index];
  const std::size_t n = run.length_mm.size();
  fmt::format_to(to, "    <BALLBAR_RUN>\n      <RUN_DIRECTION>{}</RUN_DIRECTION>\n", name_of(run.direction));
  if (run.bar_temperature_degC) {
    fmt::format_to(to, "      <RUN_TEMPERATURE>{}</RUN_TEMPERATURE>\n", *run.bar_temperature_degC);
  }
  fmt::format_to(to,
                 "      <START_INDEX>{}</START_INDEX>\n      <END_INDEX>{}</END_INDEX>\n"
                 "      <SAMPLE_RATE>{}</SAMPLE_RATE>\n      <READINGS>",
                 overshoot, overshoot + n - 1, sample_rate_Hz(run, sweep.arc));
  for (std::size_t i = 0; i < n + 2 * overshoot; ++i) {
    const std::size_t reading = i < overshoot ? 0 : i - overshoot < n ? i - overshoot : n - 1;
    fmt::format_to(to, "{}{:+.5f}", i == 0 ? "" : " ", run.length_mm[reading] - run.nominal_length_mm);
  }
  fmt::format_to(to, "</READINGS>\n");
  const std::string parent = fmt::format("run {}", index);
  for (const StoredFeature& feature : test.stored) {
    if (feature.parent == parent) write_feature(to, feature);
  }
  fmt::format_to(to, "    </BALLBAR_RUN>\n");
}

// One ANALYSIS for each stretch of features with the same parent.
void write_analyses(Out to, const B5r& test) {
  std::string_view open;
  for (const StoredFeature& feature : test.stored) {
    if (feature.parent.starts_with("run ")) continue;
    if (feature.parent != open) {
      if (!open.empty()) fmt::format_to(to, "  </ANALYSIS>\n");
      open = feature.parent;
      const std::size_t space = open.find(' ');
      fmt::format_to(to, "  <ANALYSIS NAME=\"{}\"", escaped(open.substr(0, space)));
      if (space != std::string_view::npos) fmt::format_to(to, " version=\"{}\"", escaped(open.substr(space + 1)));
      fmt::format_to(to, ">\n");
    }
    write_feature(to, feature);
  }
  if (!open.empty()) fmt::format_to(to, "  </ANALYSIS>\n");
}

}  // namespace

std::string write_b5r(const B5r& test, std::size_t overshoot_readings) {
  expect_writable(test);
  const Sweep_deg sweep = sweep_of(test.runs.front());
  fmt::memory_buffer out;
  const Out to = std::back_inserter(out);
  fmt::format_to(to, "\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"utf-8\" standalone=\"yes\"?>\n<TEST_DOCUMENT>\n");
  write_spec(to, test, sweep);
  fmt::format_to(to, "  <DATE_STARTED>{}</DATE_STARTED>\n", date(*test.runs.front().started_s));
  fmt::format_to(to,
                 "  <EQUIPMENT>\n    <BALLBAR>\n      <MODEL>{}</MODEL>\n    </BALLBAR>\n"
                 "    <SOFTWARE>\n      <VERSION>{}</VERSION>\n    </SOFTWARE>\n  </EQUIPMENT>\n  <RUN_RESULTS>\n",
                 escaped(test.ballbar_model), escaped(test.software_version));
  for (std::size_t i = 0; i < test.runs.size(); ++i) write_run(to, test, i, sweep, overshoot_readings);
  fmt::format_to(to, "  </RUN_RESULTS>\n");
  write_analyses(to, test);
  fmt::format_to(to, "</TEST_DOCUMENT>\n");
  return fmt::to_string(out);
}

}  // namespace ballbar

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/units.hpp"
#include "recordings/b5r_parts.hpp"
#include "recordings/b5r_written.hpp"

namespace ballbar {
namespace {

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

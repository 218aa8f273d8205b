#include "measure/five_probe_drift.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "ballbar/drift/thermal_test.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/logs/column_named.hpp"
#include "ballbar/formats/series/drift_files.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "ballbar/internal/series/speed_steps.hpp"
#include "ballbar/units.hpp"
#include "measure/drift_text.hpp"
#include "terminal/caller.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kStepsShown = 20;

std::string heading(const DriftAxis& axis) { return fmt::format("{} {}", axis.name, axis.unit); }

std::string cell(const std::optional<Estimate>& estimate) { return estimate ? with_sigma(*estimate) : "-"; }

Table range_table(const TableOf<DriftRange>& ranges, const std::string& of) {
  Table table({of, "first 60 min", "after 60 min", "last 60 min", "total", "first to last"});
  for (const auto& [name, range] : ranges) {
    table.add({fmt::format("{} {}", name, range.unit), cell(range.first_60_min), cell(range.after_60_min),
               cell(range.last_60_min), cell(range.total), cell(range.at_end)});
  }
  return table;
}

std::string speed_heading(const std::string& unit) {
  return unit == "mm_per_min" ? "feed mm/min" : unit == "deg_per_min" ? "speed deg/min" : "speed rpm";
}

// Drift at the end of each step, and range within it.
Table step_table(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps, const std::string& unit) {
  std::vector<std::string> names{"start min", "end min", speed_heading(unit)};
  for (const DriftAxis& axis : drift.axes) names.push_back(heading(axis));
  Table table(names);
  for (const SpeedStep& step : steps) {
    std::vector<std::string> row{fmt::format("{:8.2f}", min_from_s(drift.time_s[step.begin])),
                                 fmt::format("{:.2f}", min_from_s(drift.time_s[step.end - 1])),
                                 fmt::format("{:.0f}", step.speed_rpm)};
    for (const DriftAxis& axis : drift.axes) {
      const DriftRange range = range_of(axis, drift.time_s, step.begin, step.end);
      std::size_t last = step.end - 1;
      while (last > step.begin && std::isnan(axis.value[last])) --last;
      row.push_back(range.total ? fmt::format("{:.2f} ({:.2f})", axis.value[last], range.total->value_um) : "-");
    }
    table.add(row);
  }
  return table;
}

// Largest sigma of a row, with its sources.
std::string sigma_text(const DriftAxis& axis) {
  std::size_t worst = 0;
  bool known = false;
  for (std::size_t row = 0; row < axis.value.size(); ++row) {
    const double sigma = sigma_of(axis, row);
    if (std::isnan(sigma) || std::isnan(axis.value[row])) continue;
    if (!known || sigma > sigma_of(axis, worst)) worst = row;
    known = true;
  }
  if (!known) return fmt::format("{} not known", axis.name);
  std::vector<std::string> sources;
  for (const Contribution& contribution : axis.budget) {
    if (!std::isnan(contribution.sigma[worst])) {
      sources.push_back(fmt::format("{} {:.3f}", contribution.source, contribution.sigma[worst]));
    }
  }
  return fmt::format("{} {:.3f} {} ({})", axis.name, sigma_of(axis, worst), axis.unit, fmt::join(sources, ", "));
}

// When each axis is stable after each change of the speed, in min.
void print_settling_of_steps(const FiveProbeReport& report, const MeasuredDrift& drift,
                             const std::vector<SpeedStep>& steps, const std::string& unit) {
  std::vector<std::string> names{"start min", speed_heading(unit)};
  for (const DriftAxis& axis : drift.axes) {
    if (axis.unit == "um") names.push_back(axis.name + " min");
  }
  Table table(names);
  for (const SpeedStep& step : steps) {
    std::vector<std::string> row{fmt::format("{:8.2f}", min_from_s(drift.time_s[step.begin])),
                                 fmt::format("{:.0f}", step.speed_rpm)};
    for (const AxisSettling& one : settling_of(drift, step.begin, step.end, report.stable_um)) {
      row.push_back(one.is_small || (one.stable && one.stable->time_s == 0.0) ? "0"
                    : !one.stable                                             ? "-"
                                  : with_sigma(min_from_s(one.stable->time_s), min_from_s(one.stable->sigma_s),
                                               decimals_showing(2, min_from_s(one.stable->sigma_s), 1)));
    }
    table.add(row);
  }
  if (!report.details) table.shorten(kStepsShown);
  fmt::print("Time after each change of speed until the drift stays within {} of its final value\n{}",
             report.stable_um ? fmt::format("{:g} um", *report.stable_um) : "2 um, or 10 % of the range of the step,",
             table.text());
  fmt::print(
      "0: from the start. -: not determined. Beyond the end of a step the time is that of the fitted curve.\n\n");
}

void print_text(const FiveProbeReport& report, const MeasuredDrift& drift, const std::vector<SpeedStep>& steps,
                const DriftSheet& sheet) {
  fmt::print("{}\n{}; {} rows over {:g} min, reference at {:g} min\n\n", report.title, drift.what, drift.time_s.size(),
             min_from_s(drift.time_s.back() - drift.time_s.front()), min_from_s(drift.reference_s));
  fmt::print("Largest drift:\n");
  for (const std::string& largest : largest_texts(sheet.largest)) fmt::print("  {}\n", largest);
  if (!sheet.courses.empty()) {
    fmt::print("\nCourse:\n");
    for (const std::string& course : course_texts(sheet.courses)) fmt::print("  {}\n", course);
    fmt::print(
        "{}",
        wrapped("No other column that changes was logged, so thermal growth, wear and a changed set-up look alike. "
                "A temperature of the spindle beside them, or the same part measured twice, tells them apart."));
  }
  const bool is_thermal = sheet.test.kind != ThermalTestKind::unknown || !sheet.test.temperatures.empty() ||
                          drift.axes.size() > 1;  // one size alone may be that of parts
  if (is_thermal) {
    fmt::print("\n");
    for (const std::string& text : thermal_test_texts(sheet.test)) fmt::print("{}", wrapped(text));
  }
  fmt::print("\n{}\n", range_table(sheet.ranges, "range (max - min)").text());
  if (!sheet.in_motion.empty()) fmt::print("{}\n", range_table(sheet.in_motion, "in motion only").text());
  if (steps.size() > 1) {
    Table table = step_table(drift, steps, sheet.test.motion_unit);
    if (!report.details) table.shorten(kStepsShown);
    fmt::print("Drift since the reference at the end of each speed step (range within the step)\n{}", table.text());
    fmt::print("\n");
  }
  if (steps.size() < 2) {
    print_settling(sheet.settling, "row");
    if (!sheet.settling.empty()) fmt::print("\n");
  } else {
    print_settling_of_steps(report, drift, steps, sheet.test.motion_unit);
  }
  std::vector<std::string> sigmas;
  for (const DriftAxis& axis : drift.axes) sigmas.push_back(sigma_text(axis));
  fmt::print("{}", wrapped(fmt::format("± is one sigma. Largest sigma of all rows: {}.", fmt::join(sigmas, "; "))));
  for (const Paragraph& remark : drift.remarks) fmt::print("{}", wrapped(remark));
}

std::string probe_complaint(const std::string& stated) {
  const std::size_t equals = stated.find('=');
  const std::string name = stated.substr(0, equals);
  if (equals != std::string::npos && std::find(kProbes.begin(), kProbes.end(), name) != kProbes.end()) return {};
  return fmt::format("expected PROBE=COLUMN with one of the probes {}, found {}", fmt::join(kProbes, ", "),
                     in_quotes(stated));
}

void set_column(Series& series, FiveProbe& probe, const std::string& stated) {  // probe_complaint() has none
  const std::size_t equals = stated.find('=');
  const auto* const known = std::find(kProbes.begin(), kProbes.end(), stated.substr(0, equals));
  const std::string column = column_named(series, stated.substr(equals + 1));
  if (find_column(series, column) == nullptr) {
    throw Error(fmt::format("--probe {}: expected a column of the file, one of {}, found \"{}\".", stated,
                            fmt::join(column_names(series), ", "), column));
  }
  probe.columns[static_cast<std::size_t>(known - kProbes.begin())] = column;
}

// `found` as it was typed: CLI11's own check of a range prints the largest double to its last digit.
std::string complaint(const std::string& found, bool above_0) {
  double value = 0.0;
  if (!CLI::detail::lexical_cast(found, value) || !std::isfinite(value) || (above_0 && !(value > 0.0))) {
    return fmt::format("expected a {}, found {}", above_0 ? "number above 0" : "finite number", found);
  }
  return {};
}

// Rows without a time are often a table of positions and approaches. Its reversal is the mean of the approaches in one
// direction less that in the other, which the names of the columns state (up, down; arrows).
std::string table_complaint(const Series& series, const std::string& name) {
  const std::string found = fmt::format("{}: expected readings over time, found rows without a time", name);
  const auto target = std::find_if(series.columns.begin(), series.columns.end(), [](const Column& column) {
    const auto is_not_rising = [](double a, double b) { return !(b > a); };
    return unit_of(column.name) == "um" && column.values.size() > 1 &&
           column.values.back() - column.values.front() > 1000.0 &&
           std::adjacent_find(column.values.begin(), column.values.end(), is_not_rising) == column.values.end();
  });
  std::vector<const Column*> up, down;
  for (const Column& column : series.columns) {
    const std::string& head = column.header.empty() ? column.name : column.header;
    const auto has = [&](const auto& words) {
      return std::any_of(std::begin(words), std::end(words),
                         [&](const char* word) { return head.find(word) != std::string::npos; });
    };
    if (has(std::array{"up", "Up", "UP", "↑"})) up.push_back(&column);
    if (has(std::array{"down", "Down", "DOWN", "↓"})) down.push_back(&column);
  }
  if (target == series.columns.end() || up.empty() || down.empty()) {
    const bool has_position = std::any_of(series.columns.begin(), series.columns.end(), [](const Column& column) {
      return unit_of(column.name) == "um" && range_of(column.values) > 1000.0;
    });
    return found + (has_position
                        ? ". A table of positions and approaches, as ISO 230-2 has it, is no drift, and is not "
                          "evaluated here."
                        : ". Of rows at equal intervals --every states the interval.");
  }
  std::vector<std::string> reversals;
  for (std::size_t row = 0; row < target->values.size(); ++row) {
    const auto mean = [&](const std::vector<const Column*>& of) {
      double sum = 0.0;
      for (const Column* column : of) sum += column->values[row];
      return sum / static_cast<double>(of.size());
    };
    reversals.push_back(fmt::format("{:.4g} mm {:.2f}", mm_from_um(target->values[row]), mean(up) - mean(down)));
  }
  return fmt::format(
      "{}: a table of {} positions with {} approaches up and {} down. It is no drift, and ISO 230-2 is not evaluated "
      "here. Reversal (mean of up less mean of down), in the unit of the columns: {}.",
      found, reversals.size(), up.size(), down.size(), fmt::join(reversals, "; "));
}

}  // namespace

void report_five_probe(const FiveProbeReport& report) {
  const MeasuredDrift drift = drift_of_log(report.series, report.how, report.title);
  const std::vector<SpeedStep> steps = steps_of(report.series);
  const DriftSheet sheet = sheet_of_log(drift, report.series, report.stable_um);
  for (const std::string& path : report.out) write_drift(drift, steps, sheet, path, report.stable_um);
  if (report.json) {
    print_json_text(json_text(drift, steps, sheet, report.stable_um));
  } else {
    print_text(report, drift, steps, sheet);
  }
  for (const std::string& path : report.out) wrote_line(path);
}

std::vector<SpeedStep> steps_of(const Series& series) {
  const Column* motion = motion_of(series);
  return motion == nullptr ? std::vector<SpeedStep>() : speed_steps(series.time_s, *motion);
}

void print_settling(const std::vector<AxisSettling>& settling, std::string_view first) {
  if (settling.empty()) return;
  fmt::print("Stable, from the first {} on:\n", first);
  for (const std::string& text : settling_texts(settling)) fmt::print("  {}\n", text);
}

DriftSheet sheet_of_session(const SessionFiles& files, const DriftSeries& drift, std::optional<double> stable_um) {
  std::vector<Series> signals;
  signals.reserve(files.signals.size());
  for (const Source& one : files.signals) signals.push_back(open_series(one));
  DriftSheet sheet = sheet_of(measured(drift, files.session), signals, {}, stable_um);
  sheet.largest = largest_drifts(drift);
  return sheet;
}

bool FiveProbeOptions::any() const {
  return !probes.empty() || spacing_mm || plane_1_from_nose_mm || resolution_um || linearity_percent ||
         from_plane_1_mm || from_nose_mm;
}

void add_five_probe_options(CLI::App& command, FiveProbeOptions& options) {
  constexpr const char* kGroup = "Five probes (overrides the file)";
  const auto add = [&](const char* name, auto& value, const char* what, const char* type) {
    return command.add_option(name, value, what)->group(kGroup)->type_name(type);
  };
  const auto number = [&](const char* name, auto& value, const char* what, const char* type, bool above_0) {
    return add(name, value, what, type)->check([above_0](const std::string& found) {
      return complaint(found, above_0);
    });
  };
  number("--from-plane-1", options.from_plane_1_mm,
         "distance of the drift from plane 1, towards plane 2; default: the session's ball, else 0", "MM", false);
  number("--from-nose", options.from_nose_mm, "distance of the drift from the spindle nose", "MM", false)
      ->excludes("--from-plane-1");
  number("--plane-1", options.plane_1_from_nose_mm, "distance of plane 1 from the spindle nose", "MM", false);
  number("--spacing", options.spacing_mm, "distance between planes 1 and 2", "MM", true);
  number("--resolution", options.resolution_um, "resolution of a probe", "UM", true);
  number("--linearity", options.linearity_percent, "largest error of a probe, in percent of the reading", "PERCENT",
         true);
  add("--probe", options.probes, "column of a probe, such as X1=ch1_um; may be repeated", "PROBE=COLUMN")
      ->allow_extra_args(false)
      ->check(probe_complaint);
}

Series stated(Series series, const FiveProbeOptions& options) {
  if (!options.any()) return series;
  FiveProbe probe = series.five_probe.value_or(FiveProbe{});
  for (const std::string& mapping : options.probes) set_column(series, probe, mapping);
  if (options.spacing_mm) probe.spacing_mm = options.spacing_mm;
  if (options.plane_1_from_nose_mm) probe.plane_1_from_nose_mm = options.plane_1_from_nose_mm;
  if (options.resolution_um) probe.resolution_um = options.resolution_um;
  if (options.linearity_percent) probe.linearity_percent = options.linearity_percent;
  series.five_probe = probe;
  return series;
}

FivePointOptions place_of(const Series& series, const FiveProbeOptions& options, const BallPlace& ball) {
  FivePointOptions how;
  if (options.from_nose_mm) {
    if (!series.five_probe || !series.five_probe->plane_1_from_nose_mm) {
      throw Error(
          "--from-nose: expected the distance of plane 1 from the nose, found none. State --plane-1 MM, or "
          "plane_1_from_nose_mm under [five_probe].");
    }
    how.from_plane_1_mm = *options.from_nose_mm - *series.five_probe->plane_1_from_nose_mm;
  } else {
    how.from_plane_1_mm = options.from_plane_1_mm.value_or(ball.from_plane_1_mm.value_or(0.0));
    if (!options.from_plane_1_mm) how.from_plane_1_sigma_mm = ball.sigma_mm.value_or(0.0);
  }
  return how;
}

// Whether a column has the name of a probe and no unit.
bool lacks_units(const Series& series) {
  return std::any_of(series.columns.begin(), series.columns.end(), [](const Column& column) {
    return column.name.size() <= 2 && unit_of(column.name).empty() &&
           std::any_of(kProbes.begin(), kProbes.end(), [&](std::string_view probe) {
             return std::toupper(static_cast<unsigned char>(column.name[0])) == probe[0] &&
                    column.name.substr(1) == probe.substr(1);
           });
  });
}

MeasuredDrift measured_drift_of(const Series& series, std::optional<double> reference_s, const std::string& name) {
  MeasuredDrift drift = measured(series, name);
  if (drift.axes.empty()) return drift;
  drift = since_reference(at_each_position(std::move(drift), series), reference_s);
  drift.what = "displacements as logged";
  const Column* motion = motion_of(series);
  return motion != nullptr && motion->role != Role::speed ? with_lengths(std::move(drift)) : drift;
}

MeasuredDrift drift_of_log(const Series& series, const FivePointOptions& how, const std::string& name) {
  if (!is_five_probe(series) && !lacks_units(series)) {
    if (!series.has_clock) throw Error(table_complaint(series, name));
    MeasuredDrift drift = measured_drift_of(series, how.reference_s, name);
    if (!drift.axes.empty()) return drift;
    if (!drift.remarks.empty()) {
      throw Error(fmt::format("{}: expected a column in um or mm that changes by at most 1 mm, found none. {}", name,
                              fmt::join(texts_of(drift.remarks), " ")));
    }
  }
  return five_point_of(series, how, name);
}

DriftSheet sheet_of_log(const MeasuredDrift& drift, const Series& series, std::optional<double> stable_um) {
  return sheet_of(drift, std::span(&series, 1), steps_of(series), stable_um);
}

MeasuredDrift five_point_of(const Series& series, const FivePointOptions& how, const std::string& name) {
  if (!is_five_probe(series)) {
    throw Error(fmt::format(
        "{}: expected columns of five probes, such as X1_um, or which columns they are, by --probe X1=COLUMN or a line "
        "`# X1 = \"COLUMN\"` under `# [five_probe]`, found the columns {}{}.",
        name, fmt::join(column_names(series), ", "), lacks_units(series) ? "; --unit '*=um' states their unit" : ""));
  }
  MeasuredDrift drift;
  try {
    drift = five_point(series, how).drift;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()));
  }
  if (drift.axes.empty()) {
    throw Error(fmt::format("{}: expected probes that give a drift or a tilt there, found none. {}", name,
                            fmt::join(texts_of(drift.remarks), " ")));
  }
  return drift;
}

}  // namespace ballbar

#include "measure/five_probe_drift.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ballbar/formats/series/drift_files.hpp"
#include "ballbar/series/speed_steps.hpp"
#include "ballbar/units.hpp"
#include "measure/five_probe_options.hpp"
#include "terminal/caller.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kStepsShown = 24;

std::string heading(const DriftAxis& axis) { return fmt::format("{} {}", axis.name, axis.unit); }

std::string cell(const std::optional<Estimate>& estimate) { return estimate ? with_sigma(*estimate) : "-"; }

Table range_table(const MeasuredDrift& drift) {
  Table table({"range (max - min)", "first 60 min", "after 60 min", "total", "first to last"});
  for (const DriftAxis& axis : drift.axes) {
    const DriftRange range = range_of(axis, drift.time_s, 0, drift.time_s.size());
    table.add(
        {heading(axis), cell(range.first_60_min), cell(range.after_60_min), cell(range.total), cell(range.at_end)});
  }
  return table;
}

// Drift at the end of each step, and range within it.
Table step_table(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps) {
  std::vector<std::string> names{"from min", "to min", "speed rpm"};
  for (const DriftAxis& axis : drift.axes) names.push_back(heading(axis));
  Table table(names);
  for (std::size_t i = 0; i < std::min(steps.size(), kStepsShown); ++i) {
    const SpeedStep& step = steps[i];
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

void print_text(const FiveProbeReport& report, const MeasuredDrift& drift, const std::vector<SpeedStep>& steps) {
  fmt::print("{}\n{}; {} rows over {:g} min, reference at {:g} min\n\n", report.title, drift.what, drift.time_s.size(),
             min_from_s(drift.time_s.back() - drift.time_s.front()), min_from_s(drift.reference_s));
  fmt::print("{}\n", range_table(drift).text());
  if (steps.size() > 1) {
    fmt::print("Steps of speed: drift since the reference at the end of the step (range within the step)\n{}",
               step_table(drift, steps).text());
    if (steps.size() > kStepsShown) fmt::print("and {} steps more (--json has them)\n", steps.size() - kStepsShown);
    fmt::print("\n");
  }
  std::vector<std::string> sigmas;
  for (const DriftAxis& axis : drift.axes) sigmas.push_back(sigma_text(axis));
  fmt::print("{}", wrapped(fmt::format("± is one sigma. Largest of a row: {}.", fmt::join(sigmas, "; "))));
  for (const std::string& remark : drift.remarks) fmt::print("{}", wrapped(remark));
}

}  // namespace

void report_five_probe(const FiveProbeReport& report) {
  const MeasuredDrift drift = five_point_of(report.series, report.how, report.title);
  const auto speed = std::find_if(report.series.columns.begin(), report.series.columns.end(),
                                  [](const Column& column) { return column.role == Role::speed; });
  std::vector<SpeedStep> steps;
  if (speed != report.series.columns.end()) steps = speed_steps(report.series.time_s, *speed);
  for (const std::string& path : report.out) write_drift(drift, steps, path);
  if (report.json) {
    print_json_text(json_text(drift, steps));
  } else {
    print_text(report, drift, steps);
  }
  for (const std::string& path : report.out) wrote_line(path);
}

}  // namespace ballbar

#include "measure/five_probe_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/nearest_name.hpp"

namespace ballbar {
namespace {

std::string names_of(const Series& series) {
  std::vector<std::string> names;
  for (const Column& column : series.columns) names.push_back(column.name);
  return fmt::format("{}", fmt::join(names, ", "));
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
  const std::string column = stated.substr(equals + 1);
  if (find_column(series, column) == nullptr) {
    throw Error(fmt::format("--probe {}: expected a column of the file, one of {}, found \"{}\".", stated,
                            names_of(series), column));
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

}  // namespace

bool FiveProbeOptions::any() const {
  return !probes.empty() || spacing_mm || plane_1_from_nose_mm || resolution_um || linearity_percent ||
         from_plane_1_mm || from_nose_mm;
}

void add_five_probe_options(CLI::App& command, FiveProbeOptions& options) {
  constexpr const char* kGroup = "Five probes (what is given here goes before what the file states)";
  const auto add = [&](const char* name, auto& value, const char* what, const char* type) {
    return command.add_option(name, value, what)->group(kGroup)->type_name(type);
  };
  const auto number = [&](const char* name, auto& value, const char* what, const char* type, bool above_0) {
    return add(name, value, what, type)->check([above_0](const std::string& found) {
      return complaint(found, above_0);
    });
  };
  number("--from-plane-1", options.from_plane_1_mm,
         "drift at this distance from plane 1, towards plane 2; default: the session's ball, else 0", "MM", false);
  number("--from-nose", options.from_nose_mm, "drift at this distance from the spindle's nose", "MM", false)
      ->excludes("--from-plane-1");
  number("--plane-1", options.plane_1_from_nose_mm, "distance of plane 1 from the nose", "MM", false);
  number("--spacing", options.spacing_mm, "distance of the planes 1 and 2", "MM", true);
  number("--resolution", options.resolution_um, "step of a probe's reading", "UM", true);
  number("--linearity", options.linearity_percent, "limit of a probe's error, percent of the reading", "PERCENT", true);
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
          "--from-nose: expected to know where plane 1 is, from --plane-1 MM or plane_1_from_nose_mm under "
          "[five_probe], found neither.");
    }
    how.from_plane_1_mm = *options.from_nose_mm - *series.five_probe->plane_1_from_nose_mm;
  } else {
    how.from_plane_1_mm = options.from_plane_1_mm.value_or(ball.from_plane_1_mm.value_or(0.0));
    if (!options.from_plane_1_mm) how.from_plane_1_sigma_mm = ball.sigma_mm.value_or(0.0);
  }
  return how;
}

MeasuredDrift five_point_of(const Series& series, const FivePointOptions& how, const std::string& name) {
  if (!is_five_probe(series)) {
    throw Error(fmt::format(
        "{}: expected columns of five probes, such as X1_um, or which columns they are, by --probe X1=COLUMN or a line "
        "`# X1 = \"COLUMN\"` under `# [five_probe]`, found the columns {}.",
        name, names_of(series)));
  }
  MeasuredDrift drift;
  try {
    drift = five_point(series, how).drift;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()));
  }
  if (drift.axes.empty()) {
    throw Error(fmt::format("{}: expected probes that give a drift or a tilt there, found none. {}", name,
                            fmt::join(drift.remarks, " ")));
  }
  return drift;
}

}  // namespace ballbar

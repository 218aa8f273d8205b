// `ballbar drift` of five probes, or of a log of displacements: its output and files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/drift/five_probes.hpp"
#include "ballbar/formats/results/drift_results.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "ballbar/internal/series/speed_steps.hpp"
#include "ballbar/series/series.hpp"

namespace CLI {
class App;
}

namespace ballbar {

struct FiveProbeReport {
  std::string title;
  Series series;
  FivePointOptions how;
  std::vector<std::string> out;
  bool details = false;  // all steps
  bool json = false;
  std::optional<double> stable_um;  // settling_of()
};

void report_five_probe(const FiveProbeReport& report);

// What a user states about five probes on the command line, overriding the file.

struct FiveProbeOptions {
  std::vector<std::string> probes;  // "X1=ch1_um"
  std::optional<double> spacing_mm, plane_1_from_nose_mm, resolution_um, linearity_percent;
  std::optional<double> from_plane_1_mm, from_nose_mm;

  bool any() const;
};

void add_five_probe_options(CLI::App& command, FiveProbeOptions& options);

// The series with the stated five_probe. Throws Error for an unknown or repeated probe or column.
Series stated(Series series, const FiveProbeOptions& options);

// The position for the drift: from the options, else the position of the ball in the session, else plane 1. Throws
// Error for a distance from the nose if the position of plane 1 is not known.
FivePointOptions place_of(const Series& series, const FiveProbeOptions& options, const BallPlace& ball = {});

// The drift of five probes; `name`: their file, for messages.
MeasuredDrift five_point_of(const Series& series, const FivePointOptions& how, const std::string& name);

// The numbers of its sheet, with the signals of the session.
DriftSheet sheet_of_session(const SessionFiles& files, const DriftSeries& drift, std::optional<double> stable_um = {});

// Of the measured columns of a series; without axes where it has none that may be a drift.
MeasuredDrift measured_drift_of(const Series& series, std::optional<double> reference_s, const std::string& name);
// The numbers of its sheet, with the columns of its series.
DriftSheet sheet_of_log(const MeasuredDrift& drift, const Series& series, std::optional<double> stable_um = {});

// Of five probes, else of the columns that were measured. Throws Error where there is neither.
MeasuredDrift drift_of_log(const Series& series, const FivePointOptions& how, const std::string& name);
std::vector<SpeedStep> steps_of(const Series& series);  // of its speed; none: it has no column of it

// "Stable, from the first row on:", and a line for each axis.
void print_settling(const std::vector<AxisSettling>& settling, std::string_view first);

}  // namespace ballbar

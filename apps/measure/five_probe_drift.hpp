// `ballbar drift` of five probes: what it prints and writes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/five_probes.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
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
};

void report_five_probe(const FiveProbeReport& report);

// What a user states about five probes on the command line, over what their file states.

struct FiveProbeOptions {
  std::vector<std::string> probes;  // "X1=ch1_um"
  std::optional<double> spacing_mm, plane_1_from_nose_mm, resolution_um, linearity_percent;
  std::optional<double> from_plane_1_mm, from_nose_mm;

  bool any() const;
};

void add_five_probe_options(CLI::App& command, FiveProbeOptions& options);

// The series with its five_probe as stated. Throws Error: a probe or a column that is not there, twice the same.
Series stated(Series series, const FiveProbeOptions& options);

// Where drift is wanted: as the options say, else where the session says the ball was, else at plane 1. Throws
// Error: a distance from the nose where it is not known where plane 1 is.
FivePointOptions place_of(const Series& series, const FiveProbeOptions& options, const BallPlace& ball = {});

// The drift of five probes; `name` of their file stands in messages.
MeasuredDrift five_point_of(const Series& series, const FivePointOptions& how, const std::string& name);

}  // namespace ballbar

// The two drifts of a comparison.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/formats/text/source.hpp"
#include "measure/five_probe_drift.hpp"

namespace ballbar {

struct ComparedDriftOptions {
  Source a, b;  // b empty: the five probes of session a
  std::optional<double> reference_s;
  FiveProbeOptions probes;
};

struct ComparedDrifts {
  MeasuredDrift a, b;
  std::vector<std::filesystem::path> files;
  std::string title;  // of a session with its own five probes; two files have names instead
};

// Throws Error if one is not a drift, or if there is no second one.
ComparedDrifts compared_drifts_of(const ComparedDriftOptions& options);

}  // namespace ballbar

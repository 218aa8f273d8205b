// Writes a drift series as CSV (a series), JSON or MATLAB .mat v5.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ballbar/drift/drift.hpp"
#include "ballbar/drift/measured_drift.hpp"
#include "ballbar/formats/results/drift_results.hpp"
#include "ballbar/series/series.hpp"
#include "ballbar/series/speed_steps.hpp"

namespace ballbar {

// Columns x_um, x_sigma_um, ... as far as the method has them, with gaps where a test lacks a value.
Series series_of(const DriftSeries& drift);

// The result FiveProbeDrift as text, because there may be a million rows. stable_um: settling_of().
std::string json_text(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps,
                      std::optional<double> stable_um = std::nullopt);

// The extension selects the format: .csv, .json or .mat (one variable per column, same names). Throws Error for any
// other, and for .mat in a build without matio (BALLBAR_MAT=OFF), with what to install.
void write_drift(const DriftSeries& drift, const std::filesystem::path& path);
void write_drift(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps,
                 const std::filesystem::path& path);  // of five probes

}  // namespace ballbar

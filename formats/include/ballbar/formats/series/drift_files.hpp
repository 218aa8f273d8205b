// Writes a drift series as CSV (a series), JSON or MATLAB .mat v5.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/formats/results/drift_results.hpp"
#include "ballbar/internal/series/speed_steps.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Columns x_um, x_sigma_um, ... as far as the method has them, with gaps where a test lacks a value.
Series series_of(const DriftSeries& drift);

// What stands on the sheet of a thermal test. signals: what was logged beside the drift; steps: of its speed, empty if
// it has none; stable_um: settling_of().
DriftSheet sheet_of(const MeasuredDrift& drift, std::span<const Series> signals, const std::vector<SpeedStep>& steps,
                    std::optional<double> stable_um = std::nullopt);

// The result FiveProbeDrift as text, because there may be a million rows.
std::string json_text(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps, const DriftSheet& sheet,
                      std::optional<double> stable_um = std::nullopt);

// The extension selects the format: .csv, .json or .mat (one variable per column, same names). Throws Error for any
// other, and for .mat in a build without matio (BALLBAR_MAT=OFF), with what to install.
void write_drift(const DriftSeries& drift, const std::filesystem::path& path);
void write_drift(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps, const DriftSheet& sheet,
                 const std::filesystem::path& path,
                 std::optional<double> stable_um = std::nullopt);  // of five probes, or a log

}  // namespace ballbar

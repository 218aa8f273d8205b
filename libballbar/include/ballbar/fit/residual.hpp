// Where a model fails: the residual grouped by regime, time, signal value and angle, and whether it is white noise.
//
// Values that a robust fit discounted are ignored throughout.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// One group of residuals.
struct Misfit {
  std::string what;            // "regime", "time", "T_air_degC", "angle", "quadrant"; with a direction: "angle, CCW"
  std::string from, to;        // as printed, with unit: "0 min", "60 min"; equal for a name or a single value
  std::size_t n = 0;           // number of rows
  double bias_um = 0.0;        // mean residual
  double bias_sigma_um = 0.0;  // sigma of the mean under the noise model, correlation included (exact)
  double rmse_um = 0.0;
  double share = 0.0;  // of the sum of squares of all residuals
};

// Thermal regimes, from the steps of the spindle speed (speed_steps.hpp). Rest is a speed below 2 % of the largest.
//   after_change  first 10 min of every step but the first
//   warming       a higher speed than before, until 60 min after the change
//   cooling       rest, or a lower speed than before, until 2 h after the change
//   standstill    rest after that
//   steady        any other speed after that
// A rest of less than 10 min between two longer stretches of the same speed is a stop for a test and is ignored. A
// record that begins at rest begins with standstill, since the time of the stop is not known; one that begins at a
// speed begins with warming. Returns one regime per row; empty without a known speed.
enum class Regime { standstill, after_change, warming, steady, cooling };
std::vector<Regime> regimes(const std::vector<double>& time_s, const Column& speed);
std::string_view name_of(Regime regime);  // "standstill", "after a change of speed", "warming", "steady", "cooling"

// A run of consecutive rows in one regime.
struct RegimeStretch {
  Regime regime = Regime::standstill;
  double from_s = 0.0, to_s = 0.0;  // time of its first row; of the first row of the next stretch, or the last row
};

// From the first column of role speed; empty without one, or where it has no value.
std::vector<RegimeStretch> regime_stretches(const Series& data);

// Groups by regime (from the first column of role speed), by tenths of the time, and by fifths of every logged signal
// (equal numbers of rows; a signal with at most five different values: by value). Recordings (columns angle_rad,
// direction) are grouped by 30 deg sectors and by quadrants of each direction instead of signals. The groups are in
// this order; groups of fewer than 3 rows are left out.
std::vector<Misfit> where_it_fails(const Fit& fit, const Series& data);

// Tests whether the whitened residual is white: Kolmogorov-Smirnov distance of the cumulated periodogram, with its
// p-value (Stephens 1970). The residual is whitened by the noise of the fit and treated as an evenly spaced sequence.
// If its length has a prime factor above 100, the last few rows are left out. p = 1 for fewer than 16 rows, and for a
// zero residual (all below 1e-9 um).
// Source: J. Durbin, Tests for serial correlation in regression analysis based on the periodogram of least-squares
// residuals, Biometrika 56 (1969) 1.
struct Whiteness {
  std::vector<double> autocorrelation;  // of the unwhitened residual about 0, lags 1 to 10
  double periodogram_distance = 0.0;
  double p = 1.0;
};
Whiteness whiteness(const Fit& fit);

// True if the RMSE is at most 1.2 times the floor and the residual is white (p >= 0.01).
bool is_adequate(const Fit& fit, const Whiteness& whiteness);

// The group whose share of the sum of squares exceeds its share of the rows most, if by more than a tenth.
std::optional<Misfit> worst_place(const Fit& fit, const std::vector<Misfit>& where);

// What the residual is. It is not noise if p < 0.01; it is slow if a tenth of its variance is correlated.
enum class ResidualKind { too_few, not_noise, slow_not_noise, slow, noise };
struct ResidualNature {
  ResidualKind kind = ResidualKind::noise;
  double correlation_time_s = 0.0;  // of a slow one
};
ResidualNature residual_nature(const Fit& fit, const Whiteness& whiteness);

}  // namespace ballbar

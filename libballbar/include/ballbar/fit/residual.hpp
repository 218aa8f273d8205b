// Where a model fails: the residual by regime, time, value of a signal, angle; and whether it is noise.
//
// All of it is about the values that were kept: what a robust fit discounted counts nowhere.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// One group of residuals. share: of the sum of squares of all residuals.
struct Misfit {
  std::string what;      // "regime", "time", "T_air_degC", "angle", "quadrant", on one direction "angle, CCW"
  std::string from, to;  // as printed, with their unit: "0 min", "60 min"; a name or a single value: both the same
  std::size_t n = 0;
  double bias_um = 0.0;
  double bias_sigma_um = 0.0;  // of the mean of these rows under the noise model, their memory included (exact)
  double rmse_um = 0.0;
  double share = 0.0;
};

// Regimes of a warm-up, from the steps of speed (speed_steps.hpp); at rest: below 2 % of the largest speed.
//   after_change  first 10 min of every step but the first
//   warming       a higher speed than before, until 60 min after the change
//   cooling       rest, or a lower speed than before, until 2 h after the change
//   standstill    rest after that
//   steady        any other speed after that
// A rest of less than 10 min between two longer stretches of one speed is a stop for a test and does not count.
// A record that begins at rest begins with a standstill (nobody knows since when), one that begins at a speed with
// warming. One a row; none without a known speed.
enum class Regime { standstill, after_change, warming, steady, cooling };
std::vector<Regime> regimes(const std::vector<double>& time_s, const Column& speed);
std::string_view name_of(Regime regime);  // "standstill", "after a change of speed", "warming", "steady", "cooling"

// Rows of one regime that follow on each other.
struct RegimeStretch {
  Regime regime = Regime::standstill;
  double from_s = 0.0, to_s = 0.0;  // its first row; the first row of the next stretch, or the last of all
};

// By the first column of role speed; none without one, or where its speed is never known.
std::vector<RegimeStretch> regime_stretches(const Series& data);

// By regime (the first column of role speed), by tenths of the time, by fifths of every logged signal (as many rows in
// each; a signal of at most five values: by value). On recordings (columns angle_rad, direction) not by signal but by
// 30 deg and by quadrant, each direction apart. Group after group in this order; those of fewer than 3 are left out.
std::vector<Misfit> where_it_fails(const Fit& fit, const Series& data);

// Is the whitened residual white? Kolmogorov-Smirnov distance of the cumulated periodogram, p of a larger one by chance
// (Stephens 1970). The residual is whitened by the fit's noise and taken as a sequence, whatever its steps; of a length
// with a prime factor above 100 the last few rows are left out. Below 16 rows, and where nothing is left (all below
// 1e-9 um): p = 1.
// Source: J. Durbin, Tests for serial correlation in regression analysis based on the periodogram of least-squares
// residuals, Biometrika 56 (1969) 1.
struct Whiteness {
  std::vector<double> autocorrelation;  // of the residual as it is, about 0, lags 1 to 10
  double periodogram_distance = 0.0;
  double p = 1.0;
};
Whiteness whiteness(const Fit& fit);

// RMSE at most 1.2 times the floor, and what is left white (p >= 0.01).
bool is_adequate(const Fit& fit, const Whiteness& whiteness);

// Three sentences: how far from the floor, where worst, and what is left. Worst is the group whose share of the misfit
// is furthest above its share of the readings. What is left is not noise where p < 0.01.
std::vector<std::string> sentences(const Fit& fit, const std::vector<Misfit>& where, const Whiteness& whiteness);

// Of these the place alone: "while warming", "where T_air_degC is from 21 to 22 degC"; empty where it fails nowhere
// more than elsewhere.
std::string worst_place(const Fit& fit, const std::vector<Misfit>& where);

}  // namespace ballbar

// Where a model fails: the residual by regime, time, value of a signal, angle; and whether it is noise.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/fit.hpp"
#include "ballbar/series.hpp"

namespace ballbar {

// One group of residuals. share: of the sum of squares of all residuals.
struct Misfit {
  std::string what;      // "regime", "time", "T_air_degC", "angle", "quadrant"
  std::string from, to;  // as printed: "warming", or bounds with their unit: "0 min", "60 min"
  std::size_t n = 0;
  double bias_um = 0.0;
  double bias_sigma_um = 0.0;  // with the residual's memory
  double rmse_um = 0.0;
  double share = 0.0;
};

// Regimes of a warm-up, from the speed: standstill (rest since 2 time constants), warming (first 60 min of a speed that
// is higher than the one before), steady (later), after a speed change (first 10 min of any), cooling (rest or lower
// speed, first 2 h). Without a speed column: none.
enum class Regime { standstill, after_change, warming, steady, cooling };
std::vector<Regime> regimes(const std::vector<double>& time_s, const Column& speed);
std::string_view name_of(Regime regime);

// By regime, by tenths of the time, by fifths of every logged signal; on recordings (columns angle_rad, direction) by
// 30 deg and by quadrant, each direction apart. Sorted by what, then as they come; groups of fewer than 3 are left out.
std::vector<Misfit> where_it_fails(const Fit& fit, const Series& data);

// Is the whitened residual white? Kolmogorov-Smirnov distance of the cumulated periodogram, p of a larger one by
// chance.
struct Whiteness {
  std::vector<double> autocorrelation;  // of the residual as it is, lags 1 to 10
  double periodogram_distance = 0.0;
  double p = 1.0;
};
Whiteness whiteness(const Fit& fit);

// Three sentences: how far from the floor, where worst, and what is left.
std::vector<std::string> sentences(const Fit& fit, const std::vector<Misfit>& where, const Whiteness& whiteness);

}  // namespace ballbar

// Which temperature sensors a regression on effects needs, the benefit of each, and possible substitutes.
//
// Forward selection with exchanges. The sensor that gives the best set of k joins the k - 1 earlier ones. Then the
// sensor of the set whose loss costs least is exchanged for the best other one, if that improves the set. The criterion
// is the largest ln L (ridge.hpp), with five or more runs the smallest mean square error of left-out runs; dictionary,
// v and l are those of all sensors. The search is greedy: the set need not be the best of its size. Columns that are
// not temperatures are always kept.
//
// Errors are those of effect_regression.hpp, of forecasts or left-out runs. For each of them the sensors are chosen
// again from the rows that it predicts from, so that no row is predicted by sensors chosen with it. Dictionary, v and l
// are also chosen again for every set; with five or more runs once for each size, from all runs.
//
// A difference of two errors has a standard error: with d_f that of fold f (a forecast or a run), w_f its share of the
// rows and F folds, d = sum_f w_f d_f, sigma^2 = F/(F-1) sum_f w_f^2 (d_f - d)^2. One set is as good as another if its
// error is larger by at most 2 %, or by at most 10 % and sigma.
//
// Source of the method: forward selection and sequential replacement, Miller 2002, Subset Selection in Regression,
// chapter 3; the one-standard-error rule, Breiman, Friedman, Olshen, Stone 1984, section 3.4.3.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/predict/effect_regression.hpp"
#include "ballbar/predict/held_out.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct SensorSet {
  std::vector<std::string> sensors;  // chosen from all rows, the newest last
  Forecasts forecasts;               // with the sensors that each fold chooses
  double interval_scale = 1.0;       // from these
  double buys_um = 0.0;              // fall of the mean absolute error from the set with one sensor less
  double sigma_buys_um = 0.0;        // its standard error; NaN: fewer than two folds
};

// A sensor of the largest set. Errors are those of this fixed set, at its dictionary, v and l.
struct ChosenSensor {
  std::string sensor;
  std::size_t folds = 0;                 // number of folds that choose it too
  double without_um = 0.0;               // increase of the mean absolute error without it
  double sigma_um = 0.0;                 // its standard error
  bool needed = false;                   // the set is not as good without it
  std::vector<std::string> substitutes;  // the set is as good with one of these instead; empty if not needed
};

struct SensorChoice {
  std::size_t folds = 0;                  // F
  bool forecasts_ahead = false;           // true: forecasts of one record; false: left-out runs
  std::size_t rated = 0;                  // number of sensors to choose from
  std::vector<SensorSet> sets;            // of 0, 1 .. most sensors
  SensorSet all;                          // of all sensors; buys_um is relative to the largest set
  std::size_t enough = 0;                 // smallest number, 0 .. most, that is as good as the best of sets and all
  std::vector<ChosenSensor> chosen;       // of the largest set, the most important first
  std::vector<std::string> kept;          // columns that are not temperatures
  std::optional<HeldOutErrors> left_out;  // of the largest set; only with five or more runs
};

// most: at least 1. Calls `progress` before each longer step. Throws Error as trained_regression() does, for fewer
// temperatures than `most`, for none, and for too few rows for a forecast.
SensorChoice sensor_choice(std::span<const Series> runs, const std::string& target, std::size_t most,
                           const std::function<void(const std::string& what)>& progress = {},
                           const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar

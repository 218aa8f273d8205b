// Which temperature sensors a regression on effects needs, what each buys, and which would do in its place.
//
// Forward selection with exchanges: to k - 1 sensors comes the one that makes the best set of k; then, of the others,
// the one whose loss costs least gives its place to the best for it, where that set is better still. Best is the
// largest ln L (ridge.hpp), of five runs or more the least mean square of runs left out; dictionary, v and l are those
// of all sensors. Greedy: the set need not be the best of its size. Columns that are no temperatures are always kept.
//
// Errors are those of effect_regression.hpp, of forecasts or of runs left out, with the choice of sensors done anew for
// each on the rows from which it predicts, so that no row is predicted by sensors that were chosen by it. Dictionary, v
// and l are chosen anew for every set, too; of five runs or more once for each size, from all runs.
//
// A difference of two errors has a standard error: with d_f that of fold f (a forecast or a run), w_f its share of the
// rows and F folds, d = sum_f w_f d_f, sigma^2 = F/(F-1) sum_f w_f^2 (d_f - d)^2. One set is as good as another where
// its error is larger by at most 2 %, or by at most 10 % and sigma.
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
  std::vector<std::string> sensors;  // chosen by all rows, the newest last
  Forecasts forecasts;               // by what each fold chooses
  double interval_scale = 1.0;       // from these
  double buys_um = 0.0;              // by how much the mean absolute error is below that of one sensor less
  double sigma_buys_um = 0.0;        // its standard error; NaN: of fewer than two folds
};

// A sensor of the largest set. Errors here are those of this very set, at its dictionary, v and l.
struct ChosenSensor {
  std::string sensor;
  std::size_t folds = 0;                 // that choose it, too
  double without_um = 0.0;               // by how much the mean absolute error is larger without it
  double sigma_um = 0.0;                 // its standard error
  bool needed = false;                   // without it the set is not as good
  std::vector<std::string> substitutes;  // with one of these in its place it is as good; none is named where not needed
};

struct SensorChoice {
  std::size_t folds = 0;                  // F
  bool forecasts_ahead = false;           // forecasts of one record; false: runs left out
  std::size_t rated = 0;                  // sensors to choose from
  std::vector<SensorSet> sets;            // of 0, 1 .. most sensors
  SensorSet all;                          // of all; it buys what it has before the largest set
  std::size_t enough = 0;                 // the fewest, of 0 .. most, that are as good as the best of sets and all
  std::vector<ChosenSensor> chosen;       // of the largest set, the one that is missed most first
  std::vector<std::string> kept;          // columns that are no temperatures
  std::optional<HeldOutErrors> left_out;  // the largest set's, of five or more runs
};

// most: at least 1. progress is told before each longer part. Throws Error as trained_regression does, and where there
// are fewer temperatures than `most`, none, or too few rows for a forecast.
SensorChoice sensor_choice(std::span<const Series> runs, const std::string& target, std::size_t most,
                           const std::function<void(const std::string& what)>& progress = {},
                           const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar

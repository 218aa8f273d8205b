// Grows a model for prediction: finds the few effects that reproduce the regression on all effects
// (train.hpp).
//
//   S_k = S_(k-1) and the effect that lowers |f - B a - X g|^2 + n lambda |g|^2 most;   a, g minimise it
//
// f is the prediction of the regression on its training rows, by its gains alone. B holds a constant and the fitted
// curve of each term of the base model; their gains a are free. X holds effects of the catalogue on accepted columns,
// at a few shapes, divided by their standard deviations. lambda = 0.03^2 corresponds to inputs known to 3 % of their
// standard deviation (Bishop 1995, Neural Computation 7): correlated columns share a gain. The regression has already
// removed the noise of the readings, so that the choice does not follow it: projection predictive selection (Goutis,
// Robert 1998, Biometrika 85; Piironen, Paasiniemi, Vehtari 2020, Electronic Journal of Statistics 14). Effects are
// chosen for prediction: which of several correlated columns comes first says little about causes.
//
// The number of effects is the smallest whose forecasts add less than 5 % to the error of the regression,
//
//   sqrt(E^2 + D^2) < 1.05 E     E: RMSE of its forecasts,  D: RMS of the difference of both forecasts
//
// where the whole procedure, with the base model, is repeated on earlier rows only (forecast_folds). D is known far
// better than the errors themselves from three origins. Fewer effects are used if their forecasts are better by a
// paired t test of ln RMS over the origins (one-sided, 5 % over all numbers of effects together), because the
// regression itself may be worse. If the regression predicts no better than the base model, it is the fewest within 5 %
// of the best forecast. Nothing is kept without forecasts, or if the forecasts are no better than those of the base
// model. The terms of the base model are among the effects of the regression if that predicts better.
//
// Accuracy: sample-runs/spindle-46h, forecasts up to 8 h ahead from three origins; see its README.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/predict/train.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Errors of a model by its own terms, without the discrepancy of the regression.
struct GrowthErrors {
  std::size_t effects = 0;
  double rmse_um = 0.0;           // of the fitted rows
  double forecast_um = 0.0;       // RMSE of the forecasts; NaN: too few rows for any
  double forecast_mean_um = 0.0;  // their mean absolute error
  double apart_um = 0.0;          // D: RMS difference from the forecasts of the regression on all effects
};

struct GrownRevision {
  std::vector<std::string> joined;  // labels of the effects added in this revision
  std::vector<Term> terms;          // all added so far, held at their gains
};

enum class GrowthStop { as_good_as_all, best_forecast, most, no_better, untested };

struct Growth {
  std::vector<GrownRevision> revisions;  // kept revisions, with 1, 2, 3, 5, 8, 12, 18, 27, 40 effects
  std::vector<GrowthErrors> errors;      // of the base model, then of each revision, kept or not
  GrowthStop stop = GrowthStop::most;
  double all_um = 0.0;      // E: RMSE of the forecasts of the regression, by its gains alone; NaN: none
  std::size_t origins = 0;  // number of forecast origins
};

// Grows the model of one target. Calls `progress` before each longer step. Throws Error as fit() and
// effect_regression() do.
Growth growth(const Model& base, const Series& data, std::size_t target = 0,
              const std::function<void(const std::string& what)>& progress = {},
              const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar

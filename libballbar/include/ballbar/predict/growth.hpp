// A model grown to predict: the few effects that predict what the regression on all of them does
// (effect_regression.hpp).
//
//   S_k = S_(k-1) and the effect that lowers |f - B a - X g|^2 + n lambda |g|^2 most,   a, g: where that is least
//
// f is what the regression predicts on the rows that it was trained on, by its gains alone. B: a constant, and what
// each term of the base model adds as it is fitted; their gains a are free. X: an effect of the catalogue on columns
// that it accepts, at one of a few shapes, over its standard deviation. lambda = 0.03^2 stands for inputs that are
// known to 3 % of their standard deviation (Bishop 1995, Neural Computation 7): columns that move together share a
// gain. The noise of the readings was dealt with by the regression, so that the choice does not follow it: projection
// predictive selection (Goutis, Robert 1998, Biometrika 85; Piironen, Paasiniemi, Vehtari 2020, Electronic Journal of
// Statistics 14). Effects are chosen to predict: which of the columns that move together joins first says little about
// causes.
//
// How many effects: the fewest whose forecasts add less than 5 % to the error of the regression,
//
//   sqrt(E^2 + D^2) < 1.05 E     E: RMSE of its forecasts,  D: RMS of theirs less its own
//
// by forecasts for which the whole procedure, base model and all, is done again on earlier rows alone (forecast_rows).
// D is known far better than the errors themselves from three origins. Fewer, where their forecasts are better than
// those by a paired t test of ln RMS over the origins (one-sided, 5 % over all numbers of effects together): the
// regression itself may be the worse one.
// Where it predicts no better than the base model, the fewest within 5 % of the best forecast.
// Nothing is kept without forecasts, or where theirs are no better than those of the base model. The terms of the base
// model are among the effects of the regression where that predicts better.
//
// Accuracy: sample-runs/spindle-46h, forecasts up to 8 h ahead from three origins; see its README.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/predict/effect_regression.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Of the model's own terms, without what the regression knows of the curve that is left.
struct GrowthErrors {
  std::size_t effects = 0;
  double rmse_um = 0.0;           // of the rows it is fitted to
  double forecast_um = 0.0;       // RMSE of the forecasts; NaN: too few rows for any
  double forecast_mean_um = 0.0;  // their mean absolute error
  double apart_um = 0.0;          // D: RMS of the forecasts less those of the regression on all effects
};

struct GrownRevision {
  std::vector<std::string> joined;  // labels of the effects that it adds
  std::vector<Term> terms;          // all so far, held at their gains
};

enum class GrowthStop { as_good_as_all, best_forecast, most, no_better, untested };

struct Growth {
  std::vector<GrownRevision> revisions;  // that are kept: of 1, 2, 3, 5, 8, 12, 18, 27, 40 effects
  std::vector<GrowthErrors> errors;      // of the base model, then of each revision, also of those not kept
  GrowthStop stop = GrowthStop::most;
  double all_um = 0.0;      // E: RMSE of the forecasts of the regression, by its gains alone; NaN: none
  std::size_t origins = 0;  // of the forecasts
};

// Of one target; progress is told before each longer part. Throws Error as fit and effect_regression do.
Growth growth(const Model& base, const Series& data, std::size_t target = 0,
              const std::function<void(const std::string& what)>& progress = {},
              const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar

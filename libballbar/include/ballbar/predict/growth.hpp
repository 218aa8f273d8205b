// A model grown one effect at a time, as far as that pays on rows that it has not seen.
//
//   y = b + sum of the base model's terms, their shapes as fitted, gains free + sum_j g_j x_j + e
//
// x_j: an effect of the catalogue on columns that it accepts, at one of a few shapes. The next is that of the largest
// mean rise of the restricted likelihood over 16 covariances of e (memories of 600 to 30 000 s) and priors of its gain;
// gains are fitted jointly, held near 0 by those priors (src/predict/selection.hpp). It is chosen to predict: which of
// the columns that move together joins first says little about causes.
//
// Growth ends where P(none) is above 0.5, at 12 effects, or earlier: after the last row whose forecasts are better than
// those of the base model, and than those of as many surrogates, columns as smooth without a cause that are chosen and
// fitted alike. Forecasts: the whole procedure, base model and all, done again on earlier rows alone (forecast_rows).
// Without a forecast nothing is kept.
//
// Accuracy: sample-runs/spindle-46h, forecasts up to 8 h ahead from three origins; see its README.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Errors with so many effects, of what the model says without any discrepancy.
struct GrowthErrors {
  double rmse_um = 0.0;                // of the rows it is fitted to
  double forecast_um = 0.0;            // RMSE of the forecasts; NaN: too few rows for any
  double forecast_mean_um = 0.0;       // their mean absolute error
  double surrogate_um = 0.0;           // RMSE of the rows with as many surrogates
  double surrogate_forecast_um = 0.0;  // of their forecasts
  double sigma_um = 0.0;               // of the discrepancy
};

struct GrownEffect {
  std::string label;
  double log_bayes = 0.0;   // rise of ln L, nats
  double p_none = 0.0;      // that no effect is needed, before it joined
  std::vector<Term> terms;  // all so far, this one last, held at gains fitted jointly
};

enum class GrowthStop { none_needed, as_good_as_surrogates, most, untested };

struct Growth {
  std::vector<GrownEffect> effects;  // as many as are kept
  std::vector<GrowthErrors> errors;  // with 0, 1, 2 ... effects, also of those not kept
  GrowthStop stop = GrowthStop::none_needed;
  std::size_t tried = 0;      // effects before P(none) ended it
  std::size_t forecasts = 0;  // origins
};

// Of one target; progress is told before each longer part. Throws Error as fit and effect_regression do.
Growth growth(const Model& base, const Series& data, std::size_t target = 0,
              const std::function<void(const std::string& what)>& progress = {},
              const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar

// Whether what no effect is named for can be predicted all the same: the forecasts of a regression on every effect
// (effect_regression.hpp) beside those of the model as it is, of the same rows.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "ballbar/model/model.hpp"
#include "ballbar/predict/effect_regression.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct Predictability {
  Forecasts forecasts;      // of the regression: those of a later stretch of one run, or of runs left out
  double model_um = 0.0;    // RMSE of the model, fitted to the same earlier rows, or to the other runs
  bool with_model = false;  // the regression was offered the effects of the model
  bool is_better = false;   // than the model, than the last value held, and than a random walk comes by chance
};

// Of the model's first target, as `train` does it. Nothing where no regression can be made or tested: too few rows, no
// column that moves. Throws Error as fit.
std::optional<Predictability> predictability(const Model& model, const Series& data,
                                             const std::function<void(const std::string& what)>& progress = {},
                                             const Catalogue& catalogue = built_in_catalogue());

// Of forecasts alone: better than where the last value is held, and than a random walk comes by chance.
bool is_predicted(const EffectRegression& regression);

}  // namespace ballbar

// Whether an unexplained part can be predicted although no effect is named: compares the forecasts of a regression on
// all effects (effect_regression.hpp) with those of the model, on the same rows.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "ballbar/model/model.hpp"
#include "ballbar/predict/effect_regression.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct Predictability {
  Forecasts forecasts;      // of the regression: later rows of one run, or left-out runs
  double model_um = 0.0;    // RMSE of the model, fitted to the earlier rows or the other runs
  bool with_model = false;  // the effects of the model were available to the regression
  bool is_better = false;   // better than the model, than the last value, and than a random walk by chance
};

// For the first target of the model, as `train` does it. Returns nullopt if no regression can be trained or tested: too
// few rows, or only constant columns. Throws Error as fit() does.
std::optional<Predictability> predictability(const Model& model, const Series& data,
                                             const std::function<void(const std::string& what)>& progress = {},
                                             const Catalogue& catalogue = built_in_catalogue());

// Whether the forecasts are better than holding the last value, and than a random walk by chance.
bool is_predicted(const EffectRegression& regression);

}  // namespace ballbar

#include <algorithm>
#include <cmath>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/predict/train.hpp"
#include "ballbar/series/series.hpp"
#include "predict/forecasts.hpp"

namespace ballbar {
namespace {

constexpr double kNoBetter = 0.95;           // of the error of the last value held
constexpr double kHardlyBetter = 2.0 / 3.0;  // random walks reach this by chance

// Of the rows that the forecasts are of.
double model_rmse_um(const Model& model, const Series& run, const Design& design) {
  const std::vector<double>& measured = find_column(run, model.targets.front())->values;
  double sum = 0.0, count = 0.0;
  for (const ForecastFold& fold : forecast_folds(design, run)) {
    const Fit found = fit(model, rows_of(run, {0, design.row[fold.rows.front()]}));
    const Prediction prediction = predict(model, found.parameters, run);
    for (const std::size_t of_design : thinned(fold.rows, kRidgeRows)) {
      const std::size_t row = design.row[of_design];
      sum += std::pow(measured[row] - prediction.predicted_um[row], 2);
      count += 1.0;
    }
  }
  return std::sqrt(sum / count);
}

std::optional<TrainedRegression> regression_of(std::span<const Series> runs, const Model& model, bool with_model,
                                               const std::function<void(const std::string&)>& progress,
                                               const Catalogue& catalogue) {
  EffectRegressionOptions options;
  options.report = false;
  options.progress = progress;
  if (with_model) options.named = model;
  try {
    return trained_regression(runs, model.targets.front(), options, catalogue);
  } catch (const Error&) {  // too few rows, or no column to train on
    return std::nullopt;
  }
}

}  // namespace

bool is_predicted(const EffectRegression& regression) {
  const Forecasts& of = *regression.forecasts;
  return !regression.model.terms.empty() && of.rmse_um < (regression.runs > 1 ? kNoBetter : kHardlyBetter) * of.held_um;
}

std::optional<Predictability> predictability(const Model& model, const Series& data,
                                             const std::function<void(const std::string&)>& progress,
                                             const Catalogue& catalogue) {
  Model of_target = model;
  of_target.targets = {model.targets.front()};
  std::vector<Series> runs;
  for (const RowRange& range : runs_of(data.time_s)) runs.push_back(rows_of(data, range));
  bool with_model = !model.terms.empty() && can_be_named(model);
  std::optional<TrainedRegression> trained = regression_of(runs, of_target, with_model, progress, catalogue);
  if (!trained && with_model) {  // an effect of the model may not run live
    with_model = false;
    trained = regression_of(runs, of_target, with_model, progress, catalogue);
  }
  if (!trained || !trained->regression.forecasts) return std::nullopt;
  Predictability result{*trained->regression.forecasts, 0.0, with_model, false};
  result.model_um = runs.size() == 1
                        ? model_rmse_um(of_target, runs.front(), design_of(runs, of_target.targets.front(), catalogue))
                        : held_out_errors(of_target, runs, {}).rms_um;
  result.is_better = is_predicted(trained->regression) && result.forecasts.rmse_um < result.model_um;
  return result;
}

}  // namespace ballbar

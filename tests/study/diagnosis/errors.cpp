#include "errors.hpp"

#include <cmath>

namespace ballbar::study {
namespace {

Fit fit_with(const DataSet& set, const std::vector<BoundEffect>& added, Model& model) {
  model = set.model;
  for (const BoundEffect& bound : added) model.terms.push_back(term_of(bound.effect->name, bound.columns));
  return fit(model, set.data);
}

// The same truth on the same machine on another day.
DataSet on_other_duty(const DataSet& set) {
  DataSet other = data_set(other_duty(), set.believed, set.scatter);
  for (const Hidden& hidden : set.hidden) {
    other.hidden.push_back({hidden.injection, hidden.what, signal_of(*hidden.injection, other.data)});
  }
  Random random(set.options.search.seed + 77);
  finish(other, random);
  return other;
}

double rmse_on(const DataSet& other, const Model& model, const Fit& fitted) {
  const std::vector<double> predicted = predict(model, fitted.parameters, other.data).predicted_um;
  const std::vector<double>& measured = other.data.columns.back().values;
  double sum = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i) sum += std::pow(measured[i] - predicted[i], 2);
  return std::sqrt(sum / static_cast<double>(measured.size()));
}

}  // namespace

Errors errors_of(const DataSet& set, const std::vector<BoundEffect>& added) {
  std::vector<BoundEffect> truth;
  for (const Hidden& hidden : set.hidden) truth.push_back(hidden.injection->bound);
  Model with_added, with_truth;
  const Fit after = fit_with(set, added, with_added), ideal = fit_with(set, truth, with_truth);
  double square = 0.0;
  for (const double value : set.scatter_um) square += value * value / static_cast<double>(set.scatter_um.size());
  const DataSet other = on_other_duty(set);
  return {after.rmse_um / std::sqrt(square), rmse_on(other, with_added, after) / rmse_on(other, with_truth, ideal)};
}

}  // namespace ballbar::study

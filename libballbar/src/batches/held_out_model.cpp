#include "ballbar/batches/held_out_model.hpp"

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "ballbar/batches/batch_regression.hpp"
#include "ballbar/batches/merged_batches.hpp"

namespace ballbar {

HeldOutErrors held_out_errors(std::span<const double> batch_rmse_um) {
  const auto each = Eigen::VectorXd::Map(batch_rmse_um.data(), static_cast<Eigen::Index>(batch_rmse_um.size()));
  Eigen::Index worst = 0;
  const double worst_um = each.maxCoeff(&worst);
  return {each.norm() / std::sqrt(static_cast<double>(each.size())), worst_um, static_cast<std::size_t>(worst)};
}

HeldOutErrors held_out_errors(const Model& model, std::span<const Series> batches, const FitOptions& options,
                              const std::function<void(std::size_t batch)>& before_fit) {
  HeldOutErrors result;
  double squares = 0.0;
  for (std::size_t k = 0; k < batches.size(); ++k) {
    if (before_fit) before_fit(k);
    std::vector<Series> others(batches.begin(), batches.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const Fit found = fit(model, joined_batches(others, model), 0, options);
    const Series left_out = joined_batches(batches.subspan(k, 1), model);
    const Prediction prediction = predict(model, found.parameters, left_out);
    const std::vector<double>& measured = find_column(left_out, model.targets.front())->values;
    double sum = 0.0;
    for (std::size_t i = 0; i < measured.size(); ++i) sum += std::pow(measured[i] - prediction.predicted_um[i], 2);
    const double mean = sum / static_cast<double>(measured.size());
    squares += mean;
    if (std::sqrt(mean) <= result.worst_um) continue;
    result.worst_um = std::sqrt(mean);
    result.worst = k;
  }
  result.rms_um = std::sqrt(squares / static_cast<double>(batches.size()));
  return result;
}

double rms_without_model_um(std::span<const Batch> batches) {
  const Regression none{Eigen::VectorXd::Zero(batches.front().moments.mean.size() - 1), 0.0};
  double squares = 0.0;
  for (const Batch& batch : batches) squares += std::pow(rmse_um(batch.moments, none), 2);
  return std::sqrt(squares / static_cast<double>(batches.size()));
}

}  // namespace ballbar

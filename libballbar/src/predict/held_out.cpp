#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "ballbar/predict/train.hpp"

namespace ballbar {
namespace {

constexpr double kBetween_s = 864000.0;  // 10 days
constexpr double kRow_s = 1.0;           // after and before which the machine stands

}  // namespace

HeldOutErrors held_out_errors(std::span<const double> batch_rmse_um) {
  const auto each = Eigen::VectorXd::Map(batch_rmse_um.data(), static_cast<Eigen::Index>(batch_rmse_um.size()));
  Eigen::Index worst = 0;
  const double worst_um = each.maxCoeff(&worst);
  return {each.norm() / std::sqrt(static_cast<double>(each.size())), worst_um, static_cast<std::size_t>(worst)};
}

HeldOutErrors held_out_errors(const Model& model, std::span<const Series> batches, const FitOptions& options,
                              const std::function<void(std::size_t batch)>& before_fit) {
  std::vector<double> rmse_um;
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
    rmse_um.push_back(std::sqrt(sum / static_cast<double>(measured.size())));
  }
  return held_out_errors(rmse_um);
}

double rms_without_model_um(std::span<const Batch> batches) {
  const Regression none{Eigen::VectorXd::Zero(batches.front().moments.mean.size() - 1), 0.0};
  double squares = 0.0;
  for (const Batch& batch : batches) squares += std::pow(rmse_um(batch.moments, none), 2);
  return std::sqrt(squares / static_cast<double>(batches.size()));
}

Series joined_batches(std::span<const Series> batches, const Model& model) {
  std::set<std::string> names(model.targets.begin(), model.targets.end());
  for (const Term& term : model.terms) names.insert(term.columns.begin(), term.columns.end());
  Series all;
  for (const std::string& name : names) {
    const Column& first = column_of(batches.front(), name);
    all.columns.push_back({name, first.role, {}});
  }
  double begin_s = 0.0;
  const auto stand = [&](double time_s) {
    all.time_s.push_back(time_s);
    for (Column& column : all.columns) {
      column.values.push_back(column.role == Role::measured ? std::numeric_limits<double>::quiet_NaN() : 0.0);
    }
  };
  for (const Series& batch : batches) {
    if (!all.time_s.empty()) {
      stand(all.time_s.back() + kRow_s);
      begin_s = all.time_s.back() + kBetween_s;
      stand(begin_s - kRow_s);
    }
    for (const double time_s : batch.time_s) all.time_s.push_back(begin_s + time_s - batch.time_s.front());
    for (Column& column : all.columns) {
      const Column& own = column_of(batch, column.name);
      const double from = is_sensor(column) ? own.values.front() : 0.0;
      for (const double value : own.values) column.values.push_back(value - from);
    }
  }
  return all;
}

}  // namespace ballbar

#include <algorithm>
#include <cmath>

#include "ballbar/predict/predict.hpp"

namespace ballbar {

ColumnRange with_margin(const ColumnRange& range) {
  const double margin = 0.1 * (range.high - range.low);
  return {range.column, range.low - margin, range.high + margin};
}

std::optional<OutsideRange> outside_of(const ColumnRange& range, std::span<const double> values,
                                       std::span<const double> time_s) {
  const ColumnRange wider = with_margin(range);
  OutsideRange outside{range.column, 0.0, range.low, range.high, 0.0, 0};
  double farthest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double beyond = std::max(wider.low - values[i], values[i] - wider.high);
    if (!(beyond > 0.0)) continue;
    if (outside.rows++ == 0) outside.time_s = time_s[i];
    if (beyond <= farthest) continue;
    farthest = beyond;
    outside.value = values[i];
  }
  return outside.rows > 0 ? std::optional(outside) : std::nullopt;
}

std::optional<PredictionError> error_of(const RegressionPrediction& prediction, std::span<const double> measured_um,
                                        std::size_t first) {
  PredictionError of;
  for (std::size_t i = first; i < measured_um.size(); ++i) {
    const double error = measured_um[i] - prediction.predicted_um[i];
    if (!std::isfinite(error)) continue;
    of.mean_um += std::abs(error);
    of.rmse_um += error * error;
    of.within_share += std::abs(error) <= prediction.half_width_um[i] ? 1.0 : 0.0;
    ++of.rows;
  }
  if (of.rows == 0) return std::nullopt;
  const auto n = static_cast<double>(of.rows);
  of.mean_um /= n;
  of.rmse_um = std::sqrt(of.rmse_um / n);
  of.within_share /= n;
  return of;
}

Extrapolation extrapolation_of(const RegressionPrediction& prediction) {
  const auto beyond = [](const std::vector<double>& share) {
    return static_cast<std::size_t>(std::count_if(share.begin(), share.end(), [](double one) { return one > 1.0; }));
  };
  const std::size_t far = beyond(prediction.T2_of_largest), odd = beyond(prediction.Q_of_largest);
  const std::size_t few = std::max<std::size_t>(2, prediction.predicted_um.size() / 50);
  return {far, odd, far > few || odd > few};
}

}  // namespace ballbar

#include "ballbar/batches/batch_check.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar {

std::optional<PredictionError> error_of(const BatchPrediction& prediction, std::span<const double> measured_um) {
  double square = 0.0;
  std::size_t n = 0, within = 0;
  for (std::size_t i = 0; i < measured_um.size(); ++i) {
    const double error = measured_um[i] - prediction.predicted_um[i];
    if (!std::isfinite(error)) continue;
    square += error * error;
    within += std::abs(error) <= prediction.half_width_um[i] ? 1 : 0;
    ++n;
  }
  if (n == 0) return std::nullopt;
  return PredictionError{std::sqrt(square / static_cast<double>(n)),
                         static_cast<double>(within) / static_cast<double>(n)};
}

Extrapolation extrapolation_of(const BatchPrediction& prediction) {
  const auto beyond = [](const std::vector<double>& share) {
    return static_cast<std::size_t>(std::count_if(share.begin(), share.end(), [](double one) { return one > 1.0; }));
  };
  const std::size_t far = beyond(prediction.T2_of_largest), odd = beyond(prediction.Q_of_largest);
  const std::size_t few = std::max<std::size_t>(2, prediction.predicted_um.size() / 50);
  return {far, odd, far > few || odd > few};
}

}  // namespace ballbar

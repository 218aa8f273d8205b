#include "ballbar/internal/numerics/order_statistic.hpp"

namespace ballbar {

double median_step_s(std::span<const double> time_s) {
  std::vector<double> steps;
  steps.reserve(time_s.size());
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (time_s[i] > time_s[i - 1]) steps.push_back(time_s[i] - time_s[i - 1]);
  }
  return steps.empty() ? 0.0 : median(std::move(steps));
}

}  // namespace ballbar

#include "ballbar/internal/numerics/order_statistic.hpp"

namespace ballbar {

std::vector<double> less_running_median(const std::vector<double>& values, std::size_t rows) {
  std::vector<double> result;
  result.reserve(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t first = k < rows ? 0 : k - rows, end = std::min(values.size(), k + rows + 1);
    result.push_back(values[k] - median(std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(first),
                                                            values.begin() + static_cast<std::ptrdiff_t>(end))));
  }
  return result;
}

double median_step_s(std::span<const double> time_s) {
  std::vector<double> steps;
  steps.reserve(time_s.size());
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (time_s[i] > time_s[i - 1]) steps.push_back(time_s[i] - time_s[i - 1]);
  }
  return steps.empty() ? 0.0 : median(std::move(steps));
}

}  // namespace ballbar

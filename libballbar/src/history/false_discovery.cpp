#include "history/false_discovery.hpp"

#include <algorithm>
#include <numeric>

namespace ballbar {

std::vector<double> q_values(std::span<const double> p_values) {
  const std::size_t n = p_values.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t left, std::size_t right) {
    return p_values[left] < p_values[right] || (p_values[left] == p_values[right] && left < right);
  });
  std::vector<double> q(n, 1.0);
  double least = 1.0;
  for (std::size_t rank = n; rank-- > 0;) {
    least = std::min(least, p_values[order[rank]] * static_cast<double>(n) / static_cast<double>(rank + 1));
    q[order[rank]] = least;
  }
  return q;
}

double simes(std::vector<double> p_values) {
  std::sort(p_values.begin(), p_values.end());
  double least = 1.0;
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    least = std::min(least, p_values[i] * static_cast<double>(p_values.size()) / static_cast<double>(i + 1));
  }
  return least;
}

}  // namespace ballbar

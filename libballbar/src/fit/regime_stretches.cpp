#include "ballbar/fit/regime_stretches.hpp"

#include <algorithm>

namespace ballbar {

std::vector<RegimeStretch> regime_stretches(const Series& data) {
  std::vector<RegimeStretch> stretches;
  const auto speed = std::find_if(data.columns.begin(), data.columns.end(),
                                  [](const Column& column) { return column.role == Role::speed; });
  if (speed == data.columns.end()) return stretches;
  const std::vector<Regime> all = regimes(data.time_s, *speed);
  for (std::size_t row = 0; row < all.size(); ++row) {
    if (row > 0) stretches.back().to_s = data.time_s[row];
    if (row > 0 && all[row] == all[row - 1]) continue;
    stretches.push_back({all[row], data.time_s[row], data.time_s[row]});
  }
  return stretches;
}

}  // namespace ballbar

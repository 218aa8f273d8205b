#include "measure/drift_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/number_text.hpp"
#include "ballbar/units.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

std::string largest(const DriftSeries& series, const DriftQuantity& quantity) {
  const DriftPoint* best = nullptr;
  for (const DriftPoint& point : series.points) {
    const auto& now = point.*quantity.member;
    if (!now) continue;
    if (best == nullptr || std::abs(now->value_um) > std::abs((best->*quantity.member)->value_um)) best = &point;
  }
  return fmt::format("{} {} um at {:g} min", quantity.name, with_sigma(*(best->*quantity.member)),
                     min_from_s(best->time_s));
}

std::string duration(double time_s, double sigma_s) {
  const bool in_hours = time_s >= 2.0 * 3600.0;
  const double of_unit = in_hours ? 3600.0 : 60.0;
  return fmt::format("{} {}",
                     with_sigma(time_s / of_unit, sigma_s / of_unit, decimals_showing(2, sigma_s / of_unit, 2)),
                     in_hours ? "h" : "min");
}

}  // namespace

std::vector<std::string> settling_texts(const std::vector<AxisSettling>& settling) {
  std::vector<std::string> texts;
  for (const AxisSettling& one : settling) {
    const std::string band = fmt::format("{} within {:.2g} um", one.axis, one.band_um);
    if (one.is_small) {
      texts.push_back(fmt::format("{} from the start", band));
    } else if (!one.stable) {
      texts.push_back(fmt::format("{}: these rows do not determine it", band));
    } else {
      const StableTime& stable = *one.stable;
      const int decimals = decimals_showing(2, stable.final_sigma_um, 2);
      texts.push_back(fmt::format("{} after {}{}; {:.0f} % of the final {} um at the end", band,
                                  duration(stable.time_s, stable.sigma_s), stable.reached ? "" : ", beyond this record",
                                  100.0 * stable.share_at_end,
                                  with_sigma(stable.final_um, stable.final_sigma_um, decimals)));
    }
  }
  return texts;
}

bool any_has(const DriftSeries& series, std::optional<Estimate> DriftPoint::*member) {
  return std::any_of(series.points.begin(), series.points.end(),
                     [&](const DriftPoint& point) { return (point.*member).has_value(); });
}

std::vector<std::string> largest_drifts(const DriftSeries& series) {
  std::vector<std::string> texts;
  for (const DriftQuantity& quantity : kDriftQuantities) {
    if (any_has(series, quantity.member)) texts.push_back(largest(series, quantity));
  }
  const DriftPoint* largest = nullptr;
  for (const DriftPoint& point : series.points) {
    const std::optional<Estimate> all = combined_drift(point);
    if (all && (largest == nullptr || all->value_um > combined_drift(*largest)->value_um)) largest = &point;
  }
  if (largest != nullptr)
    texts.push_back(
        fmt::format("combined {} um at {:g} min", with_sigma(*combined_drift(*largest)), min_from_s(largest->time_s)));
  return texts;
}

}  // namespace ballbar

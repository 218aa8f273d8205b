#include "history/bar_changes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "ballbar/history/history.hpp"
#include "ballbar/message_catalogue.hpp"
#include "history/event_texts.hpp"
#include "history/quantity_series.hpp"
#include "history/robust_fit.hpp"
#include "history/series_judgement.hpp"

namespace ballbar {
namespace {

bool is_of_scales_alone(const MachineHistory& machine, const Finding& finding) {
  bool global = false;
  for (const FindingQuantity& quantity : finding.quantities) {
    const QuantityHistory& series = machine.series[quantity.series];
    const QuantityKind kind = kind_of(series.name, series.plane);
    if (!kind.of_scale && !kind.of_sum) return false;
    global = global || (kind.of_scale && !kind.axis);
  }
  return global;
}

}  // namespace

void note_common_bars(const AllSeries& all, History& history) {
  std::map<std::string, std::size_t> place_of;
  for (std::size_t i = 0; i < all.machines.size(); ++i) place_of[all.machines[i].name] = i;
  // The bar of each machine's last test with one.
  std::vector<std::string_view> bars(all.machines.size());
  for (const QuantitySeries& series : all.series) {
    if (is_global_scale(series.name) && !series.bar.empty()) bars[series.machine] = series.bar.back();
  }
  std::map<std::string_view, std::vector<Finding*>> steps;
  for (MachineHistory& machine : history.machines) {
    const std::string_view bar = bars[place_of.at(machine.name)];
    if (bar.empty()) continue;
    for (Finding& finding : machine.findings) {
      if (finding.kind == FindingKind::step && is_of_scales_alone(machine, finding)) steps[bar].push_back(&finding);
    }
  }
  for (const auto& [bar, findings] : steps) {
    for (Finding* one : findings) {
      const auto common = std::count_if(findings.begin(), findings.end(), [&](const Finding* other) {
        const bool same_time = other->from_s <= one->to_s + kDay_s && one->from_s <= other->to_s + kDay_s;
        return same_time && other->quantities.front().size * one->quantities.front().size > 0.0;
      });
      if (common < 2) continue;
      one->kind = FindingKind::instrument;
      one->sentence = messages::bar_stepped(day_text(one->from_s), day_text(one->to_s), common, bar);
      one->remedy = messages::bar_stepped_do();
    }
  }
}

std::vector<BarChange> bar_changes_of(const AllSeries& all, const Scatter& scatter) {
  struct Sum {
    double weights = 0.0, weighted = 0.0;
    std::set<std::string> machines;
  };
  std::map<std::pair<std::string, std::string>, Sum> sums;
  for (std::size_t i = 0; i < all.series.size(); ++i) {
    const QuantitySeries& series = all.series[i];
    const std::size_t n = series.value.size();
    if (!is_global_scale(series.name) || scatter.series[i].s <= 0.0) continue;
    for (std::size_t k = 1; k < n; ++k) {
      if (series.bar[k] == series.bar[k - 1]) continue;
      const FitColumns columns = joined(trend_columns(series.time_s).leftCols(1), step_column(n, k));
      const RobustFit fit = robust_fit(columns, series.value, scatters_of(series, scatter.series[i].s));
      const double factor = 1e3 / series.radius_mm;
      const double memory = scatter.families[series.family].memory(static_cast<double>(n) / 4.0);
      const double weight = 1.0 / (factor * factor * memory * fit.covariance(1, 1));
      Sum& sum = sums[{std::string(series.bar[k - 1]), std::string(series.bar[k])}];
      sum.weights += weight;
      sum.weighted += weight * factor * fit.gains[1];
      sum.machines.insert(all.machines[series.machine].name);
    }
  }
  std::vector<BarChange> changes;
  for (const auto& [bars, sum] : sums) {
    changes.push_back({bars.first,
                       bars.second,
                       {sum.machines.begin(), sum.machines.end()},
                       sum.weighted / sum.weights,
                       std::sqrt(1.0 / sum.weights)});
  }
  return changes;
}

}  // namespace ballbar

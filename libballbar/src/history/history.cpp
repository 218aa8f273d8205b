#include "ballbar/history/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "history/bar_changes.hpp"
#include "history/calls.hpp"
#include "history/event_texts.hpp"
#include "history/events.hpp"
#include "history/need.hpp"

namespace ballbar {
namespace {

// What a machine is made from.
struct MachineParts {
  std::size_t place = 0;            // among the names
  std::vector<std::size_t> series;  // places in AllSeries::series
  std::vector<Call*> calls;         // with q below the rate
  std::size_t judged = 0;           // calls with whatever q
};

const Tolerance* tolerance_named(std::string_view quantity, std::span<const Tolerance> tolerances) {
  const auto found = std::find_if(tolerances.begin(), tolerances.end(),
                                  [&](const Tolerance& one) { return one.quantity == quantity; });
  return found == tolerances.end() ? nullptr : &*found;
}

// The test has it.
const TestQuantity& quantity_of(const MachineTest& test, std::string_view name) {
  return *std::find_if(test.quantities.begin(), test.quantities.end(),
                       [&](const TestQuantity& one) { return one.name == name; });
}

// A step that was found at the exchange of the bar counts once.
void join_bar_steps(const AllSeries& all, std::vector<Call*>& calls) {
  std::erase_if(calls, [&](const Call* bar) {
    if (bar->kind != FindingKind::instrument) return false;
    for (Call* step : calls) {
      if (step->series != bar->series || step->kind != FindingKind::step) continue;
      const bool near = step->place.earliest <= bar->place.at && bar->place.at <= step->place.latest;
      if (near) step->place = bar->place;
      if (near || all.series[bar->series].bar.empty()) return true;
    }
    return false;
  });
}

class MachineAssembly {
 public:
  MachineAssembly(std::span<const MachineTest> tests, const HistoryOptions& options, const AllSeries& all,
                  const Scatter& scatter, MachineParts& of)
      : tests_(tests), options_(options), all_(all), scatter_(scatter), of_(of) {}

  MachineHistory machine() {
    const MachineTests& own = all_.machines[of_.place];
    machine_.name = own.name;
    machine_.groups = own.groups;
    machine_.judged = of_.judged;
    machine_.tests = own.tests.size();
    for (const std::size_t i : own.tests) {
      if (!tests_[i].started_s) continue;
      const auto time_s = static_cast<double>(*tests_[i].started_s);
      machine_.first_s = std::min(time_s, machine_.first_s.value_or(time_s));
      machine_.last_s = std::max(time_s, machine_.last_s.value_or(time_s));
    }
    join_bar_steps(all_, of_.calls);
    for (const std::size_t i : of_.series) add_series(i);
    std::vector<const Call*> calls(of_.calls.begin(), of_.calls.end());
    for (const Event& event : events_of(all_, calls)) machine_.findings.push_back(finding_of(event));
    return std::move(machine_);
  }

 private:
  void add_series(std::size_t place) {
    const QuantitySeries& series = all_.series[place];
    std::vector<Call*> own;
    for (Call* call : of_.calls) {
      if (call->series == place) own.push_back(call);
    }
    const Tolerance* tolerance = tolerance_named(series.name, options_.tolerances);
    if (tolerance == nullptr) tolerance = tolerance_named(series.name, tests_[series.tests.back()].tolerances);
    if (own.empty() && tolerance == nullptr && !options_.every_quantity) return;
    std::size_t first = 0;
    Call* trend = nullptr;
    for (Call* call : own) {
      if (call->kind == FindingKind::trend) trend = call;
      if (call->kind == FindingKind::step) first = std::max(first, call->place.at);
    }
    QuantityHistory one = history_of_series(place, own);
    if (options_.every_quantity || (tolerance != nullptr && trend != nullptr)) one.trend = trend_since(series, first);
    if (trend != nullptr && !scatter_.series[place].of_machines) {
      if (const std::optional<Trend> line = trend_since(series, first)) {
        trend->size = line->rate_per_year;
        trend->sigma = line->sigma_per_year;
      }
    }
    place_of_[place] = machine_.series.size();
    machine_.series.push_back(std::move(one));
    if (tolerance != nullptr) add_tolerance(*tolerance, trend != nullptr);
  }

  QuantityHistory history_of_series(std::size_t place, const std::vector<Call*>& calls) const {
    const QuantitySeries& series = all_.series[place];
    SeriesCurve curve = curve_with(series, scatter_.series[place], scatter_.families[series.family], calls);
    QuantityHistory one;
    one.name = series.name;
    one.unit = series.unit;
    one.plane = series.plane;
    one.group = series.group;
    one.tests = series.tests;
    one.time_s = series.time_s;
    one.value = series.value;
    one.sigma = series.sigma;
    const TestQuantity& last = quantity_of(tests_[series.tests.back()], series.name);
    one.last = last.value;
    one.last_sigma = last.sigma;
    one.fitted = std::move(curve.fitted);
    one.level = curve.level;
    one.level_sigma = curve.sigma;
    one.scatter = scatter_.series[place].s;
    one.significant = series.significant && std::abs(one.value.back()) > kSignificantSigmas * one.sigma.back();
    return one;
  }

  void add_tolerance(const Tolerance& tolerance, bool has_trend) {
    const QuantityHistory& series = machine_.series.back();
    const bool last_alone = within(tolerance, series.level) && !within(tolerance, series.last);
    machine_.tolerances.push_back(
        {machine_.series.size() - 1, series.name, series.unit, series.plane, series.level, series.level_sigma,
         tolerance, tolerance_date(tolerance, series.level, has_trend ? series.trend : std::nullopt), last_alone});
  }

  Finding finding_of(const Event& event) const {
    Finding finding;
    finding.kind = event.kind;
    finding.from_s = event.from_s;
    finding.to_s = event.to_s;
    finding.axis = event.axis;
    for (const Call* call : event.calls) {
      const std::size_t place = place_of_.at(call->series);
      const QuantityHistory& of = machine_.series[place];
      finding.quantities.push_back(
          {place, of.name, of.unit, of.plane, call->size, call->sigma, call->p_value, call->q_value});
    }
    for (const FindingQuantity& quantity : finding.quantities) {
      finding.p_value = std::min(finding.p_value, quantity.p_value);
      finding.q_value = std::min(finding.q_value, quantity.q_value);
    }
    EventTexts texts = texts_of(all_, event);
    finding.sentence = std::move(texts.sentence);
    finding.remedy = std::move(texts.remedy);
    return finding;
  }

  std::span<const MachineTest> tests_;
  const HistoryOptions& options_;
  const AllSeries& all_;
  const Scatter& scatter_;
  MachineParts& of_;
  MachineHistory machine_;
  std::map<std::size_t, std::size_t> place_of_;  // of a series in machine_.series
};

}  // namespace

std::string_view name_of(FindingKind kind) {
  constexpr std::array<std::string_view, 5> kNames{"step", "replaced_part", "instrument", "trend", "season"};
  return kNames[static_cast<std::size_t>(kind)];
}

History history_of(std::span<const MachineTest> tests, const HistoryOptions& options) {
  if (!(options.false_discovery_rate > 0.0 && options.false_discovery_rate < 1.0)) {
    throw Error(fmt::format("The false discovery rate: expected a number between 0 and 1, found {}.",
                            options.false_discovery_rate));
  }
  const AllSeries all = all_series(tests);
  const Scatter scatter = scatter_of(all);
  std::vector<Call> calls = calls_of(all, scatter);
  std::vector<MachineParts> machines(all.machines.size());
  for (std::size_t i = 0; i < machines.size(); ++i) machines[i].place = i;
  for (std::size_t i = 0; i < all.series.size(); ++i) machines[all.series[i].machine].series.push_back(i);
  History history;
  history.false_discovery_rate = options.false_discovery_rate;
  history.without_date = all.without_date;
  history.judged = calls.size();
  for (Call& call : calls) {
    ++machines[all.series[call.series].machine].judged;
    if (call.q_value > options.false_discovery_rate) continue;
    machines[all.series[call.series].machine].calls.push_back(&call);
    ++history.found;
  }
  history.machines.resize(machines.size());
  in_parallel(machines.size(), [&](std::size_t i) {
    history.machines[i] = MachineAssembly(tests, options, all, scatter, machines[i]).machine();
  });
  note_common_bars(all, history);
  for (MachineHistory& machine : history.machines) say_need(machine);
  rank(history.machines);
  history.bar_changes = bar_changes_of(all, scatter);
  return history;
}

}  // namespace ballbar

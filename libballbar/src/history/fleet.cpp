#include "ballbar/history/fleet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "ballbar/error.hpp"
#include "ballbar/history/trend.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "history/bar_changes.hpp"
#include "history/fleet_calls.hpp"
#include "history/fleet_events.hpp"
#include "history/fleet_need.hpp"
#include "history/fleet_sentences.hpp"

namespace ballbar {
namespace {

// What a machine is made from.
struct OfMachine {
  std::size_t place = 0;            // among the names
  std::vector<std::size_t> series;  // places in AllSeries::series
  std::vector<Call*> calls;         // with q below the rate
};

const Tolerance* tolerance_named(std::string_view quantity, std::span<const Tolerance> tolerances) {
  const auto found = std::find_if(tolerances.begin(), tolerances.end(),
                                  [&](const Tolerance& one) { return one.quantity == quantity; });
  return found == tolerances.end() ? nullptr : &*found;
}

// A step that was found at the exchange of the bar is not told twice.
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

// The tests since the last step, for a straight line.
std::optional<Trend> trend_since(const QuantitySeries& series, std::size_t first) {
  std::vector<DatedValue> values;
  for (std::size_t i = first; i < series.value.size(); ++i) {
    values.push_back({series.time_s[i], series.value[i], series.sigma[i]});
  }
  return trend_of(values);
}

class MachineInFleet {
 public:
  MachineInFleet(std::span<const MachineTest> tests, const FleetOptions& options, const AllSeries& all,
                 const FleetScatter& scatter, OfMachine& of)
      : tests_(tests), options_(options), all_(all), scatter_(scatter), of_(of) {}

  FleetMachine machine() {
    machine_.name = all_.machines[of_.place];
    machine_.tests = all_.tests[of_.place].size();
    for (const std::size_t i : all_.tests[of_.place]) {
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
    if (own.empty() && tolerance == nullptr) return;
    const SeriesCurve curve = curve_with(series, scatter_.series[place], scatter_.families[series.family], own);
    place_of_[place] = machine_.series.size();
    machine_.series.push_back({std::string(series.name), std::string(series.unit), series.plane, series.tests,
                               series.time_s, series.value, curve.fitted, curve.level, curve.sigma,
                               scatter_.series[place].s});
    if (tolerance != nullptr) add_tolerance(series, *tolerance, own);
  }

  void add_tolerance(const QuantitySeries& series, const Tolerance& tolerance, const std::vector<Call*>& own) {
    FleetTolerance one;
    one.series = machine_.series.size() - 1;
    one.tolerance = tolerance;
    std::size_t first = 0;
    bool trend = false;
    for (const Call* call : own) {
      trend = trend || call->kind == FindingKind::trend;
      if (call->kind == FindingKind::step) first = std::max(first, call->place.at);
    }
    const double level = machine_.series.back().level;
    one.date = tolerance_date(tolerance, level, trend ? trend_since(series, first) : std::nullopt);
    one.last_alone = within(tolerance, level) && !within(tolerance, series.value.back());
    machine_.tolerances.push_back(std::move(one));
  }

  Finding finding_of(const Event& event) const {
    Finding finding;
    finding.kind = event.kind;
    finding.from_s = event.from_s;
    finding.to_s = event.to_s;
    finding.axis = event.axis;
    for (const Call* call : event.calls) {
      finding.quantities.push_back({place_of_.at(call->series), call->size, call->sigma, call->p_value, call->q_value});
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
  const FleetOptions& options_;
  const AllSeries& all_;
  const FleetScatter& scatter_;
  OfMachine& of_;
  FleetMachine machine_;
  std::map<std::size_t, std::size_t> place_of_;  // of a series in machine_.series
};

}  // namespace

std::string_view name_of(FindingKind kind) {
  switch (kind) {
    case FindingKind::step:
      return "step";
    case FindingKind::replaced_part:
      return "replaced_part";
    case FindingKind::instrument:
      return "instrument";
    case FindingKind::trend:
      return "trend";
    case FindingKind::season:
      return "season";
  }
  return "";
}

Fleet fleet_of(std::span<const MachineTest> tests, const FleetOptions& options) {
  if (!(options.false_discovery_rate > 0.0 && options.false_discovery_rate < 1.0)) {
    throw Error(fmt::format("The false discovery rate of a fleet: expected a number between 0 and 1, found {}.",
                            options.false_discovery_rate));
  }
  const AllSeries all = all_series(tests);
  const FleetScatter scatter = fleet_scatter(all);
  std::vector<Call> calls = calls_of(all, scatter);
  std::vector<OfMachine> machines(all.machines.size());
  for (std::size_t i = 0; i < machines.size(); ++i) machines[i].place = i;
  for (std::size_t i = 0; i < all.series.size(); ++i) machines[all.series[i].machine].series.push_back(i);
  Fleet fleet;
  fleet.false_discovery_rate = options.false_discovery_rate;
  fleet.without_date = all.without_date;
  fleet.judged = calls.size();
  for (Call& call : calls) {
    if (call.q_value > options.false_discovery_rate) continue;
    machines[all.series[call.series].machine].calls.push_back(&call);
    ++fleet.found;
  }
  fleet.machines.resize(machines.size());
  in_parallel(machines.size(), [&](std::size_t i) {
    fleet.machines[i] = MachineInFleet(tests, options, all, scatter, machines[i]).machine();
  });
  note_common_bars(all, fleet);
  for (FleetMachine& machine : fleet.machines) say_need(machine);
  rank(fleet.machines);
  fleet.bar_changes = bar_changes_of(all, scatter, fleet);
  return fleet;
}

}  // namespace ballbar

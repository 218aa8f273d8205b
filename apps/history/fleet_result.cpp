#include "history/fleet_result.hpp"

namespace ballbar {

std::vector<FleetFinding> findings_of(const FleetMachine& machine) {
  std::vector<FleetFinding> findings;
  for (const Finding& finding : machine.findings) {
    FleetFinding one{finding, {}};
    for (const FindingQuantity& quantity : finding.quantities)
      one.quantities.push_back({machine.series[quantity.series], quantity});
    findings.push_back(std::move(one));
  }
  return findings;
}

std::vector<OfSeries<FleetTolerance>> tolerances_of(const FleetMachine& machine) {
  std::vector<OfSeries<FleetTolerance>> tolerances;
  for (const FleetTolerance& tolerance : machine.tolerances)
    tolerances.push_back({machine.series[tolerance.series], tolerance});
  return tolerances;
}

std::vector<FleetBarChange> bar_changes_of(const Fleet& fleet) {
  std::vector<FleetBarChange> changes;
  for (const BarChange& change : fleet.bar_changes) {
    FleetBarChange one{change, {}};
    for (const std::size_t place : change.machines) one.machines.push_back(fleet.machines[place].name);
    changes.push_back(std::move(one));
  }
  return changes;
}

}  // namespace ballbar

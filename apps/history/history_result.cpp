#include "history/history_result.hpp"

#include <utility>

namespace ballbar {

GeometryResult result_of(const MachineGeometry& geometry, const std::vector<MachineTest>& tests) {
  GeometryResult result{geometry.within_a_day,
                        {},
                        geometry.scales,
                        {geometry.chi2, geometry.degrees, geometry.p_value, geometry.scatter_ppm, {}}};
  for (const PlaneSquareness& plane : geometry.squareness) {
    SquarenessResult one{plane, {}};
    for (const std::size_t i : plane.tests) one.files.push_back(tests[i].file);
    result.squareness.push_back(std::move(one));
  }
  for (const ScalePull& pull : geometry.pulls)
    result.agreement.pulls.push_back({pull, tests[pull.test].file, tests[pull.test].plane});
  return result;
}

std::vector<FindingResult> findings_of(const MachineHistory& machine) {
  std::vector<FindingResult> findings;
  for (const Finding& finding : machine.findings) {
    FindingResult one{finding, {}};
    for (const FindingQuantity& quantity : finding.quantities)
      one.quantities.push_back({machine.series[quantity.series], quantity});
    findings.push_back(std::move(one));
  }
  return findings;
}

std::vector<OfSeries<ToleranceOutlook>> tolerances_of(const MachineHistory& machine) {
  std::vector<OfSeries<ToleranceOutlook>> tolerances;
  for (const ToleranceOutlook& tolerance : machine.tolerances)
    tolerances.push_back({machine.series[tolerance.series], tolerance});
  return tolerances;
}

std::vector<BarChangeResult> bar_changes_of(const History& history) {
  std::vector<BarChangeResult> changes;
  for (const BarChange& change : history.bar_changes) {
    BarChangeResult one{change, {}};
    for (const std::size_t place : change.machines) one.machines.push_back(history.machines[place].name);
    changes.push_back(std::move(one));
  }
  return changes;
}

HistoryResult result_of(const TestFiles& files, const History& history, const MachineGeometry& geometry) {
  HistoryResult result{history, {}, files.remarks, files.skipped};
  if (history.machines.size() == 1) result.geometry.value = result_of(geometry, files.tests);
  return result;
}

}  // namespace ballbar

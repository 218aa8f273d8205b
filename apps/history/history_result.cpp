#include "history/history_result.hpp"

#include <utility>

namespace ballbar {
namespace {

using Tests = std::vector<MachineTest>;

QuantityResult result_of(const QuantityHistory& quantity, const Tests& tests) {
  QuantityResult result{quantity, {quantity.last_value, quantity.last_sigma, quantity.significant, {}}};
  if (!quantity.tests.empty()) result.last.date.value = moment_of(tests[quantity.tests.back()].started_s);
  return result;
}

GroupResult result_of(const GroupHistory& history, const Tests& tests) {
  GroupResult result{history.group, {}, {}};
  for (const std::size_t i : history.group.tests)
    result.tests.push_back({tests[i].file, moment_of(tests[i].started_s), tests[i].stored});
  for (const QuantityHistory& quantity : history.quantities) result.quantities.push_back(result_of(quantity, tests));
  return result;
}

GeometryResult result_of(const MachineGeometry& geometry, const Tests& tests) {
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

}  // namespace

HistoryResult result_of(const TestFiles& files, const std::vector<MachineHistory>& machines) {
  HistoryResult result{{}, {}, files.remarks, files.skipped};
  for (const MachineHistory& machine : machines) {
    MachineResult one{machine.machine, machine.changes, machine.trends, {}, result_of(machine.geometry, files.tests)};
    for (const GroupHistory& group : machine.groups) one.groups.push_back(result_of(group, files.tests));
    result.machines.push_back(std::move(one));
  }
  for (const MachineTest& test : files.tests) {
    if (!test.started_s) result.without_date.push_back(test.file);
  }
  return result;
}

}  // namespace ballbar

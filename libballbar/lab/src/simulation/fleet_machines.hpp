// The machines of a virtual fleet: constants, stories, bars.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "ballbar/lab/simulation/virtual_fleet.hpp"

namespace ballbar {

// The constants of one machine, by error and axis or plane.
struct FleetMachineTruth {
  std::size_t machine = 0;
  std::string name;
  std::map<std::string, double> constant;  // "squareness_xy"
  // With what the stories add at that time; of one axis, or of the plane.
  double value(const VirtualFleet& fleet, const std::string& error, const std::optional<int>& axis, Plane plane,
               double since_s, std::int64_t at_s) const;
};

FleetMachineTruth machine_truth(const VirtualFleet& fleet, std::size_t machine, std::mt19937_64& random);

// -1 to 1: -1 in the middle of January, 1 in that of July.
double warmth_of_year(std::int64_t at_s);

struct BarInUse {
  std::string serial;
  double um_per_m = 0.0;
};
BarInUse bar_of(const VirtualFleet& fleet, std::size_t machine, double month);

// The spread that is stated for each column, null where none is.
struct SpreadsOfColumns {
  ErrorSpread scale;
  std::vector<const ErrorSpread*> of_column;
};
SpreadsOfColumns spreads_of(const VirtualFleet& fleet, const FleetCurves& curves);

// Throws Error where the fleet is contradictory.
void check_fleet(const VirtualFleet& fleet, const FleetCurves& curves);

}  // namespace ballbar

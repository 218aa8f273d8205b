// The parts of `simulate`, one file each: what is refused; the truth between its points, logged series, the spindle
// behind a machine.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ballbar/lab/simulation/simulate.hpp"

namespace ballbar::simulation {

// Throws Error where the machine is contradictory.
void check(const VirtualMachine& machine);

// Straight lines between the points (time_s rising), held beyond the first and the last.
double interpolated(const std::vector<double>& time_s, const std::vector<double>& value, double at_s);

TruePosition truth_at(const VirtualMachine& machine, double at_s);

// first, first + interval, ... to the first time at or after last.
std::vector<double> clock_s(double first_s, double last_s, double interval_s);

Series signals_of(const VirtualMachine& machine);
Series five_probe_of(const VirtualMachine& machine);
Series truth_of(const VirtualMachine& machine);

void check(const SpindleMeasurement& measurement, const Series& sensors);
bool is_logged(const SpindleMeasurement& measurement, const std::string& name);

// The machine with the run's positions as its truth and what is logged of its sensors added to its signals.
VirtualMachine moved_by(const VirtualMachine& machine, const ThermalRun& run);

// Columns of the causes at the tests, change since the first, in the sign of the machine's truth.
std::vector<Column> causes_at_tests(const VirtualMachine& machine, const ThermalRun& run);

SimulatedSession series_of(const VirtualMachine& machine);

}  // namespace ballbar::simulation

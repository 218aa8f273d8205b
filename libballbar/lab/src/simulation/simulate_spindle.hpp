// A finite-volume spindle behind a virtual machine.
#pragma once

#include "ballbar/lab/simulation/simulate.hpp"

namespace ballbar::simulation {

void check(const SpindleMeasurement& measurement, const Series& sensors);
bool is_logged(const SpindleMeasurement& measurement, const std::string& name);

// The machine with the run's positions as its truth and what is logged of its sensors added to its signals.
VirtualMachine moved_by(const VirtualMachine& machine, const ThermalRun& run);

// Columns of the causes at the tests, change since the first, in the sign of the machine's truth.
std::vector<Column> causes_at_tests(const VirtualMachine& machine, const ThermalRun& run);

SimulatedSession series_of(const VirtualMachine& machine);

}  // namespace ballbar::simulation

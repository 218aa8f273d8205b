// A finite-volume spindle as it is measured: noise, resolution, what is not logged; and as the cause of a virtual
// machine's drift.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ballbar/lab/spindle/finite_volume_spindle.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// A reading is the true value + noise, rounded last. Speed, load and time are exact.
struct SpindleMeasurement {
  double noise_um = 0.15;       // of x, y, z: standard deviation of what is independent from row to row
  double tail_freedom = 0.0;    // > 2: that noise is Student's t with so many degrees of freedom, whole; 0: normal
  double memory_um = 0.0;       // standard deviation of an AR(1) noise beside it
  double memory_s = 600.0;      // its correlation falls as exp(-dt / this)
  double resolution_um = 0.05;  // 0: not rounded
  double temperature_noise_K = 0.03;
  double temperature_resolution_K = 0.1;
  std::vector<std::string> not_logged;  // columns of ThermalRun::sensors that are left out
};

struct VirtualSpindle {
  FiniteVolumeSpindle body;
  Mechanisms mechanisms;
  DutyPlan plan;
  ThermalClock clock;
  SpindleMeasurement measurement;
};

// Another spindle of the same build: every loss, conductance, mass and share of a side times exp(spread w), w normal
// and its own from number to number. Lengths, materials and counts stay, and a share stays within -1 and 1. The same
// seed gives the same spindle. spread 0.2 makes most of them differ by a fifth.
FiniteVolumeSpindle varied(const FiniteVolumeSpindle& spindle, double spread, std::uint64_t seed);

// Rows of the run: what is logged of its sensors, then x_um, y_um, z_um. The same seed gives the same numbers; every
// column has its own stream, so that leaving one out changes no other. Throws Error, "spindle: ...", for noise that
// makes no sense and for a column that is not there.
Series measured_series(const ThermalRun& run, const SpindleMeasurement& measurement, std::uint64_t seed);

}  // namespace ballbar

// Many machines, each with ballbar tests over time: which of them changed, which wear, and which only follow the
// season.
//
// Of each machine, plane, kind of test and quantity, the values y_i at t_i are held against four curves, the tests of
// one day with one bar as one value:
//
//   level        y = a
//   step         y = a + b [t >= t_k],                              from two values on either side
//   trend        y = a + b t
//   season       y = a + b sin(2 pi t / year) + c cos(2 pi t / year), over a year and a half at least
//
// by least squares with Huber's loss, so that single tests that were set up badly count little. The scatter s from test
// to test is that of successive values, moderated by the scatters of the same quantity on all machines (Smyth). How
// heavy its tails are, and how much more the mean of several tests scatters than independent tests would, is learnt
// from all machines: a fleet is its own measure. A p value is that of a step, a trend, a season against none of them,
// and beside the best of the three against that one alone.
//
// All p values of all machines are corrected together (Benjamini and Hochberg), once each and once a machine (Simes);
// q is the larger of both: of the findings with q below 0.05 one in twenty is by chance, and so of the machines.
// What was found is then told as one event a date and a machine: a crash, a part that was replaced, an instrument that
// was exchanged.
//
// Sources: P. J. Huber, Robust Statistics (1981). G. K. Smyth, Stat. Appl. Genet. Mol. Biol. 3 (2004). Y. Benjamini and
// Y. Hochberg, J. R. Stat. Soc. B 57 (1995). R. J. Simes, Biometrika 73 (1986).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/history/machine_test.hpp"
#include "ballbar/history/tolerance_date.hpp"

namespace ballbar {

enum class FindingKind {
  step,           // several quantities at one date, or one: a collision, a part that came loose, an adjustment
  replaced_part,  // errors of one axis step to the better together
  instrument,     // all axes' scales step alike, with the bar: not the machine
  trend,          // wear, settling
  season,         // follows the year: neither wear nor a step
};
std::string_view name_of(FindingKind kind);

struct FleetOptions {
  std::vector<Tolerance> tolerances;  // go before those that the newest test states
  double false_discovery_rate = 0.05;
};

// One quantity of one kind of test of a machine, over time.
struct FleetSeries {
  std::string name, unit;
  Plane plane = Plane::XY;
  std::vector<std::size_t> tests;  // places in what was given, by date; several of a day make one value
  std::vector<double> time_s, value;
  std::vector<double> fitted;  // the curve, at the same dates
  double level = 0.0;          // of that curve at the last test
  double sigma = 0.0;          // of the level
  double scatter = 0.0;        // s
};

struct FindingQuantity {
  std::size_t series = 0;               // place in FleetMachine::series
  double size = 0.0;                    // step: after less before; trend: a year; season: half from trough to peak
  double sigma = 0.0;                   // of the size
  double p_value = 1.0, q_value = 1.0;  // q: corrected for all that was looked at
};

struct Finding {
  FindingKind kind = FindingKind::step;
  std::vector<FindingQuantity> quantities;  // the clearest first, what follows from others last
  // A step: the last test before and the first after it. A trend, a season: the first and the last test.
  double from_s = 0.0, to_s = 0.0;
  double p_value = 1.0, q_value = 1.0;  // of the clearest quantity
  std::optional<int> axis;              // 0, 1, 2 of X, Y, Z, where it is one axis
  std::string sentence;                 // what was found
  std::string remedy;                   // what to do
};

// Of one quantity that has a tolerance.
struct FleetTolerance {
  std::size_t series = 0;
  Tolerance tolerance;
  ToleranceDate date;       // by the level, and where there is a trend by the tests since the last step
  bool last_alone = false;  // the last test is beyond, the level is not
};

enum class Need { beyond, expected, finding, nothing };
std::string_view name_of(Need need);

struct FleetMachine {
  std::string name;  // as its tests state it; of those that state none, their folder
  std::size_t tests = 0;
  std::optional<double> first_s, last_s;
  Need need = Need::nothing;
  std::string reason;                         // why it stands where it does
  std::optional<std::size_t> reason_finding;  // the place of the finding that the reason is
  std::vector<Finding> findings;              // the clearest first
  std::vector<FleetTolerance> tolerances;
  std::vector<FleetSeries> series;  // those that findings and tolerances name
};

// Tests with one bar, then with another.
struct BarChange {
  std::string from, to;                    // serial numbers; equal: calibrated anew
  std::vector<std::size_t> machines;       // places in Fleet::machines
  double size_ppm = 0.0, sigma_ppm = 0.0;  // mean step of all scales
};

struct Fleet {
  std::vector<FleetMachine> machines;  // what needs something first
  std::vector<BarChange> bar_changes;
  std::size_t judged = 0;  // p values: machine, quantity and kind
  std::size_t found = 0;   // of these with q below the rate
  double false_discovery_rate = 0.05;
  std::size_t without_date = 0;  // tests that are in nothing
};

// Throws Error for a rate that is not between 0 and 1. O(n log n) in tests; 10^5 tests of 35 quantities take seconds.
Fleet fleet_of(std::span<const MachineTest> tests, const FleetOptions& options = {});

}  // namespace ballbar

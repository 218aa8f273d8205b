// Machines over their ballbar tests: which of them changed, which wear, which only follow the season, and what meets
// its tolerance when. One machine is a plant of one.
//
// Of each machine, kind of test and quantity, the values y_i at t_i are held against four curves, the tests of one day
// with one bar as one value:
//
//   level        y = a
//   step         y = a + b [t >= t_k],                              from two values on either side
//   trend        y = a + b t
//   season       y = a + b sin(2 pi t / year) + c cos(2 pi t / year), over a year and a half at least
//
// by least squares with Huber's loss, so that single tests that were set up badly count little. The scatter s from test
// to test is that of successive values, moderated by the scatters of the same quantity on all machines (Smyth). How
// heavy its tails are, and how much more the mean of several tests scatters than independent tests would, is learnt
// from all machines. Where fewer than four machines have the quantity, they tell no scatter: a trend is then judged by
// trend_of, which holds it against the sigmas of the fits. A p value is that of a step, a trend, a season against none
// of them, and that of a curve with the best of the three against the best alone.
//
// All p values of all machines are corrected together (Benjamini and Hochberg), once each and once a machine (Simes);
// q is the larger of both: of the findings with q below 0.05 one in twenty is by chance, and so of the machines.
// Findings of one date and machine are one event: a crash, a part that was replaced, an instrument that was exchanged.
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
#include "ballbar/history/trend.hpp"

namespace ballbar {

enum class FindingKind {
  step,           // several quantities at one date, or one: a collision, a part that came loose, an adjustment
  replaced_part,  // errors of one axis step to the better together
  instrument,     // all axes' scales step in common, with the bar: not the machine
  trend,          // wear, settling
  season,         // follows the year: neither wear nor a step
};
std::string_view name_of(FindingKind kind);

struct HistoryOptions {
  std::vector<Tolerance> tolerances;  // go before those that the newest test states
  double false_discovery_rate = 0.05;
  bool every_quantity = false;  // of which nothing was found too
};

// One quantity of one group of tests of a machine, over time; tests of a day with one bar are one value, their mean.
struct QuantityHistory {
  std::string name, unit;
  Plane plane = Plane::XY;
  std::size_t group = 0;           // place in MachineHistory::groups
  std::vector<std::size_t> tests;  // places in what was given, by date; the last of each day
  std::vector<double> time_s, value;
  std::vector<double> sigma;   // NaN: not known
  std::vector<double> fitted;  // the curve, at the same dates
  double level = 0.0;          // of that curve at the last test
  double level_sigma = 0.0;
  double scatter = 0.0;        // s
  bool significant = false;    // the last value: its error is, and it is beyond kSignificantSigmas
  std::optional<Trend> trend;  // through the values since the last step
};

struct FindingQuantity {
  std::size_t series = 0;  // place in MachineHistory::series
  std::string name, unit;
  Plane plane = Plane::XY;
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
struct ToleranceOutlook {
  std::size_t series = 0;
  std::string name, unit;
  Plane plane = Plane::XY;
  double level = 0.0, level_sigma = 0.0;
  Tolerance tolerance;
  ToleranceDate date;       // by the level, and where there is a trend by the tests since the last step
  bool last_alone = false;  // the last test is beyond, the level is not
};

enum class Need { beyond, expected, finding, nothing };
std::string_view name_of(Need need);

struct MachineHistory {
  std::string name;  // empty: its tests state none
  std::size_t tests = 0;
  std::optional<double> first_s, last_s;
  std::size_t judged = 0;  // questions: quantity and kind
  Need need = Need::nothing;
  std::string reason;                         // why it stands where it does
  std::optional<std::size_t> reason_finding;  // the place of the finding that the reason is
  std::vector<Finding> findings;              // the clearest first
  std::vector<ToleranceOutlook> tolerances;
  std::vector<QuantityHistory> series;  // those that findings and tolerances name, or every one
  std::vector<TestGroup> groups;        // with places in what was given
};

// Tests with one bar, then with another.
struct BarChange {
  std::string from, to;                    // serial numbers; equal: calibrated anew
  std::vector<std::string> machines;       // by name
  double size_ppm = 0.0, sigma_ppm = 0.0;  // mean step of all scales
};

struct History {
  std::vector<MachineHistory> machines;  // what needs something first
  std::vector<BarChange> bar_changes;
  std::size_t judged = 0;  // p values: machine, quantity and kind
  std::size_t found = 0;   // of these with q below the rate
  double false_discovery_rate = 0.05;
  std::vector<std::string> without_date;  // files of tests that are in nothing
};

// Tests that name no machine belong to the only one that is named, or make one of their own. Throws Error for a rate
// that is not between 0 and 1. O(n log n) in tests; 10^5 tests of 35 quantities take seconds.
History history_of(std::span<const MachineTest> tests, const HistoryOptions& options = {});

}  // namespace ballbar

// The history of machines over their ballbar tests: which machines changed, which wear, which follow the season, and
// when a quantity reaches its tolerance. A single machine is a fleet of one.
//
// For each machine, kind of test and quantity, four curves are fitted to the values y_i at t_i. Tests of one day with
// one bar count as one value:
//
//   level        y = a
//   step         y = a + b [t >= t_k],                              at least two values on either side
//   trend        y = a + b t
//   season       y = a + b sin(2 pi t / year) + c cos(2 pi t / year), over at least a year and a half
//
// The fit uses Huber's loss, so that single bad set-ups have little weight. The scatter s from test to test comes from
// successive values, moderated by the scatter of the same quantity on all machines (Smyth). All machines together
// determine how heavy the tails are, and how much more the mean of several tests scatters than that of independent
// tests. With fewer than four machines the scatter is not known: trend_of() then judges a trend against the sigmas of
// the fits. The p-values test a step, a trend or a season against a constant, and two of these curves together against
// the best one alone.
//
// The p-values of all machines are corrected together (Benjamini and Hochberg), once for each and once per machine
// (Simes); q is the larger of both. Of the findings with q below 0.05 one in twenty is by chance, and likewise of the
// machines. Findings of one machine and date are one event: a crash, a replaced part, an exchanged instrument.
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
#include "ballbar/message.hpp"

namespace ballbar {

enum class FindingKind {
  step,           // of one or several quantities at one date: a collision, a loose part, an adjustment
  replaced_part,  // errors of one axis improve together in one step
  instrument,     // the scales of all axes step together with a change of the bar; not the machine
  trend,          // wear, settling
  season,         // follows the year: neither wear nor a step
};
std::string_view name_of(FindingKind kind);

struct HistoryOptions {
  std::vector<Tolerance> tolerances;  // override those that the newest test states
  double false_discovery_rate = 0.05;
  bool every_quantity = false;  // also quantities without findings
};

// One quantity of one group of tests of a machine over time. Tests of one day with one bar are one value, their mean.
struct QuantityHistory {
  std::string name, unit;
  Plane plane = Plane::XY;
  std::size_t group = 0;           // place in MachineHistory::groups
  std::vector<std::size_t> tests;  // indices into the given tests, by date; the last of each day
  std::vector<double> time_s, value;
  std::vector<double> sigma;   // NaN: not known
  std::vector<double> fitted;  // the curve, at the same dates
  double last = 0.0;           // value of the last test; value.back() is the mean of its day
  double last_sigma = 0.0;     // NaN: not known
  double level = 0.0;          // of that curve at the last test
  double level_sigma = 0.0;
  double scatter = 0.0;        // s
  bool significant = false;    // of the last value: its error is significant, and it exceeds kSignificantSigmas
  std::optional<Trend> trend;  // through the values since the last step
};

struct FindingQuantity {
  std::size_t series = 0;  // place in MachineHistory::series
  std::string name, unit;
  Plane plane = Plane::XY;
  double size = 0.0;                    // step: after minus before; trend: change per year; season: amplitude
  double sigma = 0.0;                   // of the size
  double p_value = 1.0, q_value = 1.0;  // q: corrected for all tests made
};

struct Finding {
  FindingKind kind = FindingKind::step;
  std::vector<FindingQuantity> quantities;  // the most significant first, derived ones last
  // Step: times of the last test before and the first after it. Trend, season: times of the first and the last test.
  double from_s = 0.0, to_s = 0.0;
  double p_value = 1.0, q_value = 1.0;  // of the most significant quantity
  std::optional<int> axis;              // 0, 1, 2 for X, Y, Z; nullopt: not a single axis
  Paragraph sentence;                   // what was found
  Paragraph remedy;                     // what to do
};

// The outlook of one quantity that has a tolerance.
struct ToleranceOutlook {
  std::size_t series = 0;
  std::string name, unit;
  Plane plane = Plane::XY;
  double level = 0.0, level_sigma = 0.0;
  Tolerance tolerance;
  ToleranceDate date;       // from the level, and from the trend since the last step if there is one
  bool last_alone = false;  // the last test exceeds the tolerance, the level does not
};

enum class Need { beyond, expected, finding, nothing };
std::string_view name_of(Need need);

struct MachineHistory {
  std::string name;  // empty: the tests state no name
  std::size_t tests = 0;
  std::optional<double> first_s, last_s;
  std::size_t judged = 0;  // number of hypothesis tests: quantity and kind
  Need need = Need::nothing;
  Paragraph reason;                           // why the machine has this need
  std::optional<std::size_t> reason_finding;  // index of the finding that is the reason
  std::vector<Finding> findings;              // the clearest first
  std::vector<ToleranceOutlook> tolerances;
  std::vector<QuantityHistory> series;  // those with findings or tolerances, or all
  std::vector<TestGroup> groups;        // with indices into the given tests
};

// A change from one bar to another.
struct BarChange {
  std::string from, to;                    // serial numbers; equal: recalibrated
  std::vector<std::string> machines;       // names
  double size_ppm = 0.0, sigma_ppm = 0.0;  // mean step of all scales
};

struct History {
  std::vector<MachineHistory> machines;  // sorted by need, the most urgent first
  std::vector<BarChange> bar_changes;
  std::size_t judged = 0;  // number of p-values: machine, quantity and kind
  std::size_t found = 0;   // number of these with q below the rate
  double false_discovery_rate = 0.05;
  std::vector<std::string> without_date;  // files of tests that were ignored
};

// Tests without a machine name belong to the only named machine, or form a machine of their own. Throws Error for a
// rate outside 0 to 1. O(n log n) in tests; 10^5 tests of 35 quantities take seconds.
History history_of(std::span<const MachineTest> tests, const HistoryOptions& options = {});

}  // namespace ballbar

// Machines over their ballbar tests: one test with its conditions, comparable tests, trends, the geometry of a machine,
// and which machines changed.
//
//   machine_test()      one test: quantities, conditions, limits; without readings
//   groups_of()         tests that may be compared: plane, length, arc, feed
//   trend_of()          a line through dated values with its uncertainty, and when it reaches a limit
//   machine_geometry()  squareness and scales of a machine from tests of its planes
//   history_of()        steps, trends and seasons of all machines, corrected for the number of tests made
//
// Sigma. The sigma of a quantity is that of its fit: it does not have the scatter from set-up to set-up, which only
// several tests show. trend_of() and history_of() estimate that scatter. Stored values have no sigma (NaN); they are
// used with the scatter alone.
//
// Dates are seconds since 1970-01-01T00:00:00 on the clock of the machine, without a zone. Values are in the unit of
// the quantity: um, um/m, ms, ppm.
//
// Accuracy (tests/study, fleet): of a simulated plant all stories were found and 1 machine of 700 without one called,
// of another 97 % and 6 of 3100. A single machine is judged less well: 17 % of those without a story are called.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

struct TestQuantity {
  std::string
      name;  // a row or a group of MachineErrors, or "circularity", "residual_rms", "scale_x", "scale_y", "scale_z"
  std::string unit;
  double value = 0.0;
  double sigma = std::numeric_limits<double>::quiet_NaN();  // NaN: not known, as for stored values
  bool of_set_up = false;                // describes the position of the bar, not the machine; has no history
  bool significant = true;               // false: of an error that is not significant
  std::optional<std::size_t> rank = {};  // of its error, 1: largest gain from correction; nullopt: no rank
};

// Tolerance limits in the unit of the quantity; either end may be open.
struct Tolerance {
  std::string quantity;
  std::optional<double> lower, upper;
};

bool within(const Tolerance& tolerance, double value);

// One test of a machine. What its file does not state stays empty; an empty condition is no difference.
struct MachineTest {
  std::string file;
  std::string second_file;                // the file of the other direction; empty: same file
  std::string machine;                    // as the file names it; empty: not stated
  std::string bar;                        // its serial number; empty: not stated
  std::optional<std::int64_t> started_s;  // on the machine's clock, s since 1970-01-01T00:00:00
  Plane plane = Plane::XY;
  double nominal_length_mm = 100.0;
  std::optional<double> feed_mm_per_min;
  double start_deg = 0.0;  // of the readings, counter-clockwise, [0, 360)
  double arc_deg = 360.0;
  std::vector<Direction> directions;  // directions of its recordings, each once; empty: not stated
  bool stored = false;                // the file has stored values and no readings
  std::vector<TestQuantity> quantities;
  std::vector<Tolerance> tolerances;       // stated in the file
  std::vector<std::string> beyond_limits;  // names of stored results that fail a limit in the file
  std::optional<bool> passes;              // the tolerance of the circularity and these limits; nullopt: not asked
  std::optional<AxisScales> scales;        // of axes_of(plane)
  std::optional<MachineError> squareness;  // of the plane; sigma NaN: not known
};

// The conditions of the test of these recordings, without results.
MachineTest test_head(std::span<const Recording> recordings);

// The test of these recordings with the results of machine_errors(); file, machine and bar stay empty. The feed is the
// mean of the recordings, the date the earliest. Sigma of the circularity: that of a difference of two readings with
// the noise of the fit. Sigma of residual_rms: from the effective number of independent readings.
MachineTest machine_test(const MachineErrors& errors, std::span<const Recording> recordings);

// "scale_x", "scale_y", "scale_z" for axis 0, 1, 2.
std::string scale_name(int axis);

// ---- A group of comparable tests of a machine.
//
// Tests are comparable if plane, nominal length, arc and feed agree, with any bar. Sorted values are split into groups
// at gaps of more than 0.1 mm in length, 2 deg in arc and start, 5 % in feed. Full circles compare whatever their
// start.

struct TestGroup {
  Plane plane = Plane::XY;
  double nominal_length_mm = 100.0;
  double start_deg = 0.0, arc_deg = 360.0;
  std::optional<double> feed_mm_per_min;  // of the last test; nullopt: not stated
  std::vector<std::size_t> tests;         // indices of the tests, by date, undated ones first
};

// A condition in which two tests of one plane differ. Tests that differ in length, arc or feed belong to different
// groups. A condition that one test does not state is no difference.
enum class TestCondition {
  nominal_length,
  arc,
  feed,
  directions,
  bar,
  machine,
  stored,  // one has readings, the other only results of the instrument's software
};
std::string_view name_of(TestCondition condition);

std::vector<TestCondition> differing_conditions(const MachineTest& one, const MachineTest& other);

// Groups the tests at these indices by plane, length, arc and feed. O(n log n).
std::vector<TestGroup> groups_of(std::span<const MachineTest> tests, std::vector<std::size_t> places);

// ---- A linear trend through dated values that scatter by more than their sigmas.
//
//   y_i = v + r (t_i - t_last) + e_i,     var e_i = sigma_i^2 + tau^2
//
// tau, the scatter of a machine from test to test (set-up, temperature), is unknown, and few tests determine it poorly.
// The line is therefore averaged over tau, weighted by the restricted likelihood times a half-Cauchy prior with a scale
// of three times the usual sigma. Intervals of three tests are then wide enough, and those of many tests approach
// weighted least squares with the scatter added. Values without a sigma take the usual sigma of the others. If no value
// has one, the prior is 1/tau, which gives Student's t.
//
// Sources: D. A. Harville, J. Am. Stat. Assoc. 72 (1977): restricted likelihood. A. Gelman, Bayesian Analysis 1 (2006):
// half-Cauchy priors for the variance between groups.

inline constexpr double kYear_s = 365.25 * 86400.0;
inline constexpr double kDay_s = 86400.0;
// A change or a trend is significant beyond this many sigmas; one in 107 is so by chance.
inline constexpr double kSignificantSigmas = 2.6;

struct DatedValue {
  double time_s = 0.0;
  double value = 0.0;
  double sigma = 0.0;  // NaN: not known
};

// The line for one tau: value at the last test and rate per year, normal with this covariance.
struct TrendLine {
  double weight = 1.0;  // the weights of all lines sum to 1
  double value = 0.0, rate_per_year = 0.0;
  double value_variance = 0.0, covariance = 0.0, rate_variance = 0.0;
};

struct Trend {
  std::size_t tests = 0;
  double last_s = 0.0;
  double rate_per_year = 0.0;
  double sigma_per_year = 0.0;  // half of the 68.3 % interval
  double p_value = 1.0;         // two-sided, of rate 0
  bool significant = false;     // beyond kSignificantSigmas
  double scatter = 0.0;         // median of tau
  std::vector<TrendLine> lines;
};

// Returns nullopt for fewer than 3 values, or if all lie within a week. Values in any order. O(n).
std::optional<Trend> trend_of(std::span<const DatedValue> values);

// The probability that the line at `time_s` is above the limit, and the quantile of the line at `time_s`.
double chance_above(const Trend& trend, double time_s, double limit);
double quantile(const Trend& trend, double time_s, double chance);

// ---- When a quantity reaches its tolerance if its trend continues.

inline constexpr double kForecast_years = 10.0;  // longest extrapolation of a trend

enum class Outlook {
  beyond,    // the last value exceeds the tolerance
  no_trend,  // too few tests, or no significant trend
  away,      // the trend leads to an open end, or reaches no limit within kForecast_years
  expected,  // the trend reaches a limit within kForecast_years
};

struct ToleranceDate {
  Outlook outlook = Outlook::no_trend;
  std::optional<double> limit;  // the limit that the trend leads to
  // In s since 1970-01-01T00:00:00: median of the time at which the line reaches the limit, and its 95 % interval, from
  // the last test on. `latest_s` is nullopt if the line may not reach the limit within kForecast_years.
  std::optional<double> at_s, earliest_s, latest_s;
};

ToleranceDate tolerance_date(const Tolerance& tolerance, double last_value, const std::optional<Trend>& trend);

// ---- Squareness of a machine's planes and scale errors of its axes, from one or more tests per plane.
//
// A test in the plane of axes A and B measures both scales, with the covariance C of its own fit:
//
//   (s_A, s_B)' = (scale of A, scale of B)' + e,     cov e = C
//
// All tests together give the scales by weighted least squares. An axis that lies in two planes is measured twice.
// chi^2 tells how well the measurements agree; the pull of each is its residual over the sigma of the residual. If the
// agreement is worse than 1 % by chance, a common scatter is added to each scale of a test, so that chi^2 equals the
// degrees of freedom. A wrong length of the bar changes all scales alike; the tests cannot show it.
//
// Source of the scatter: R. C. Paule and J. Mandel, J. Res. Natl. Bur. Stand. 87 (1982).

struct PlaneSquareness {
  Plane plane = Plane::XY;
  double value = 0.0;
  double sigma = 0.0;  // NaN: of stored values
  std::string unit;
  std::vector<std::size_t> tests;
  std::vector<std::string> files;  // of these
  double p_value = 1.0;            // of equal values in all tests; below 0.01 the sigma is widened
};

struct AxisScale {
  int axis = 0;  // 0, 1, 2 of X, Y, Z
  double value_ppm = 0.0;
  double sigma_ppm = 0.0;  // NaN: of stored values
  std::size_t planes = 0;  // number of planes in which it is measured
};

struct ScalePull {
  std::string file;  // of the test
  Plane plane = Plane::XY;
  int axis = 0;
  double value_ppm = 0.0, sigma_ppm = 0.0;  // of that test
  double pull = 0.0;                        // residual over its sigma; NaN: only this test measures the axis
};

// Whether the tests agree.
struct ScaleAgreement {
  double chi2 = 0.0;
  std::size_t degrees = 0;  // 0: nothing to compare
  double p_value = 1.0;
  double scatter_ppm = 0.0;  // added to each scale of a test if the tests disagree
  std::vector<ScalePull> pulls;
};

struct MachineGeometry {
  std::vector<std::size_t> tests;  // indices of the tests used, by plane and date
  bool within_a_day = true;
  std::vector<PlaneSquareness> squareness;
  std::vector<AxisScale> scales;
  ScaleAgreement agreement;
};

// Uses the tests within a day before the newest; for a plane without one, its newest test. Tests with a sigma take
// precedence over stored values, dated ones over others. Tests without squareness and scales are ignored.
MachineGeometry machine_geometry(std::span<const MachineTest> tests);

// ---- The history of machines over their ballbar tests: which machines changed, which wear, which follow the season,
// and when a quantity reaches its tolerance. A single machine is a fleet of one.
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

// Named columns over time, as a logger writes them: temperatures, speed, readings of probes, a drift. Also: several
// runs stacked to one series, series of several clocks merged, and faults of columns.
//
// A column's name ends in its unit ("T_air_degC", "n_rpm"), and its role says how a model may use it. A gap is NaN.
// time_s rises strictly; the time of the first row is free. Values are kept as they were read: nothing is smoothed,
// thinned or filled here.
//
// Units are those of units.hpp. Functions of this header are linear in rows times columns unless they say otherwise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

// The role of a column in a model. Unless the file states it, the unit decides: `_rpm` speed,
// `_degC` structure, `_um`, `_mm` and `_urad` measured, `_A`, `_W`, `_Nm` and `_percent` load; anything else is an
// event.
enum class Role { structure, ambient, coolant, bearing, mean_point, housing, speed, load, event, measured };

struct Column {
  std::string name;  // ends in its unit: "T_air_degC"
  Role role = Role::structure;
  std::vector<double> values;  // one a row; a gap is NaN
  std::string header = {};     // as its file writes the name; empty: as `name`
};

// Five probes on a bar in the spindle (ISO 230-3 layout): what a file or a user states about them. Plane 1 is
// the one near the spindle's nose, plane 2 the other.
inline constexpr std::array<std::string_view, 5> kProbes{"X1", "X2", "Y1", "Y2", "Z"};
struct FiveProbe {
  std::optional<double> spacing_mm;            // distance of planes 1 and 2
  std::optional<double> plane_1_from_nose_mm;  // distance of plane 1 from the spindle's nose
  std::optional<double> resolution_um;         // the smallest step of a reading
  std::optional<double> linearity_percent;     // limit of the probe's error, percent of the reading
  std::array<std::string, 5> columns{"X1_um", "X2_um", "Y1_um", "Y2_um", "Z_um"};  // of the series, as kProbes
};

// How a run began: at rest in thermal equilibrium, or still warm from earlier work.
enum class RunStart { rest, warm };

// One of several runs.
struct RunOrigin {
  std::string name;  // of its file
  RunStart start = RunStart::rest;
};

// A jump of the zero of a sensor, taken out of its column.
struct SensorJump {
  std::string column, run;  // run: its name; empty: there is one
  double time_s = 0.0, size = 0.0;
};

// Rows in the order of time.
struct Series {
  std::vector<double> time_s;  // strictly rising; with several runs (series.hpp) within each
  std::vector<Column> columns;
  std::optional<FiveProbe> five_probe;  // from the file's [five_probe] table
  std::optional<std::string> started;   // wall clock at time_s = 0, "2026-11-22T13:05:10", no zone; nullopt: not known
  std::vector<RunOrigin> runs;          // one per run if there are several; else empty
  std::vector<std::string> unread;      // columns of the log that hold states in words, which nothing reads
  std::vector<SensorJump> sensor_jumps;
  bool has_clock = true;  // false: no file states the time, and time_s numbers the rows 0, 1, 2 ...
};

// Unit at the end of a column's name ("um", "mm", "urad", "degC", "rpm", "A", "W", "K", "percent", "Nm", "bar",
// "l_per_min", "mm_per_min", "deg_per_min", "V"), empty if there is none.
std::string_view unit_of(std::string_view column_name);

Role role_from_unit(std::string_view unit);
std::string_view name_of(Role role);
std::optional<Role> role_from_name(std::string_view name);

// Adds the columns that nothing reads to those of another series.
void add_unread(const Series& part, Series& all);

// The column of that name, or nullptr.
const Column* find_column(const Series& series, std::string_view name);

std::vector<std::string> column_names(const Series& series);

// Whether a model could explain the column: it is measured, and not the sigma of another column.
bool is_target(const Column& column);

// The name, with a number before its unit if it is already in `taken`. Adds the result to `taken`.
std::string free_name(std::string_view name, std::set<std::string>& taken);

// ---- Several runs of one machine as one series, stacked. The time of each run starts again.
//
// A new run begins where `time_s` falls. The memory of effects and noise restarts there, and a model has an offset for
// each run (run_terms.hpp), because no set-up repeats exactly. Thresholds in temperature (a kink, a viscosity) refer to
// the first row of the first run, because all runs are of one machine.

struct RowRange {
  std::size_t begin = 0, end = 0;  // rows [begin, end)
};

// One range per run; empty without rows.
std::vector<RowRange> runs_of(std::span<const double> time_s);

// The series of one run.
Series rows_of(const Series& data, const RowRange& range);

// Rising times with the runs end to end, for a picture or a file. A run begins one clock step after the last row.
std::vector<double> one_after_another(std::span<const double> time_s);

struct Stacked {
  Series series;
  std::vector<std::string> remarks;  // whole sentences: which columns were left out
};

// Stacks the runs in their order; a single run is returned unchanged. Columns that some runs lack are left out. Roles
// are those of the first run. A run begins warm if it began less than 8 h after the end of another, or if its speed is
// not 0 in the first row. zeros_s: the wall clock at time_s = 0 of each run (Series::started), in s since a common day;
// empty: not known. Throws Error, with the names of the runs: fewer than two rows, no common column, a column in
// different units (T_bed_degC, T_bed_K), the same rows twice, wall clocks that overlap.
Stacked stacked(const std::vector<Series>& runs, const std::vector<std::string>& names,
                const std::vector<std::optional<double>>& zeros_s = {});

// ---- Merges a drift and the signals logged during it into one series.

// The result has a row at every time of every part, within the time that all signals cover. Each part keeps its own
// clock and nothing is decimated. Measured columns have values only where they were measured. Signals (every role but
// measured and event) are interpolated linearly across gaps of at most max_gap_s; nullopt: 3 median steps of the
// signal's own values, and at least 10 min. A row within a longer gap is left out. A gap without a row in it costs
// nothing: rows read by hand may stop for the night. An event keeps its last value, and is interpolated as a signal
// where its values are smooth (signal_kind) and not whole numbers; before the first value it is a gap. The first
// [five_probe] table is kept. O(rows times columns).
//
// Throws Error: a column in two parts, a signal without any value, parts without common time, less than two thirds of
// the rows, or of the values of a measured column, outside the gaps of signals.
Series merged(const std::vector<Series>& parts, std::optional<double> max_gap_s);

// Rows that merged() leaves out for want of a signal. A row may lack several.
struct RowsWithout {
  std::string signal;
  std::size_t rows = 0;
  double max_gap_s = 0.0;  // longest gap over which this signal is interpolated
};
std::vector<RowsWithout> rows_without_signal(std::span<const Series> parts, std::optional<double> max_gap_s);

// A stretch with rows, between two values of a signal.
struct SignalGap {
  std::string signal;
  double from_s = 0.0, to_s = 0.0;
};
// Where merged() throws for the rows within gaps: the longest gap, with which as max_gap_s it keeps all rows. nullopt:
// it does not throw for them.
std::optional<SignalGap> longest_gap(std::span<const Series> parts, std::optional<double> max_gap_s);

// merged() of one series, keeping the start of its clock. Returns the series itself, not a copy, if it has no gap.
std::shared_ptr<const Series> with_gaps_closed(std::shared_ptr<const Series> series, std::optional<double> max_gap_s);

// ---- Possible faults in the columns of a series, for a first check of the data.

enum class FaultKind : std::uint8_t {
  pauses,      // steps of time of more than 10 usual ones
  few_values,  // fewer than three
  gaps,        // in more than 5 % of the rows
  constant,    // in all rows
  stuck,       // constant in the last tenth of the rows, and more than 20 of them, after changes before
  far_off,     // up to three values in a row that are far off their neighbours: more than 10 sigma off the running
               // median of seven
  clipped,     // stands at its largest or smallest value, though it changes by more than its resolution just before
  jumps,  // of a measured column, three or more: in one step, by far more than it changes otherwise, while no input
          // jumps
};
std::string_view name_of(FaultKind kind);

struct ColumnFault {
  std::string column;  // empty: the time
  FaultKind kind = FaultKind::constant;
  std::size_t count = 0;  // pauses, rows or jumps
  double value = 0.0;     // constant, stuck, clipped: at which it stands; far_off: the first; jumps: their median size;
                          // pauses: the longest, in s; gaps: their share of the rows
  double at_s = 0.0;      // of the first of them; pauses: of the longest
  double long_s = 0.0;    // stuck, clipped: for how long in all; pauses: the shortest that counts
  bool is_low = false;    // clipped: at its smallest value
  bool is_beyond = false;  // far_off: beyond the range of all other values
};

// Columns of speed, load and events rest and jump by nature: of these only few values, gaps and constants are found.
// O(n) per column.
std::vector<ColumnFault> column_faults(const Series& series);

// Those that bear on what a model says of a target: of it, and of the columns of temperatures and other smooth inputs.
// Gaps and pauses change no verdict, a constant says that it does not change, and readings of an input far off their
// neighbours count only beyond its range.
std::vector<ColumnFault> faults_bearing_on(const Series& series, std::string_view target);

}  // namespace ballbar

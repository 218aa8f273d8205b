// The offset for one axis of a machine, computed row by row as its sensors report. The offset is the negative of the
// predicted error, limited so that it is safe for a control.
//
//   error_i    = model(row i) - model(first row)        um; the machine is zeroed at the first row
//   wanted_i   = - error_i
//   offset     moves towards wanted, by at most rate_um_per_s dt and at most step_um per row, within +- largest_um
//   counts     whole increments of resolution_um: unchanged while |offset - counts resolution| is at most
//              (1/2 + hysteresis) resolution, so that noise at the edge of an increment causes no chatter
//
// A row with an implausible sensor or time holds the offset: the counts stay, the model ignores the row, and the reason
// is reported. After the hold the offset moves on at the same rate. Reasons for a hold, checked for each column of the
// model:
//
//   no_value         a gap, NaN or infinity
//   spike            a temperature that differs from the last accepted one by more than spike_K + heating_K_per_s times
//                    the time since; accepted again once it is nearer, or enough time has passed
//   stuck            a temperature with exactly the same value for stuck_s, while rows arrived
//   out_of_range     outside the trained range (Model::trained), widened by range_margin of its span at either end. A
//                    column without a trained range is not checked
//   no_time          a time that is not a number, or more than 1e12 s from 0
//   clock_back       a time not after the last one. The new clock is accepted with the next row that continues it; the
//                    time in between counts as 0
//   clock_gap        a time more than gap_s after the last one, and more than twice the previous interval; accepted
//                    with the next row that continues it or keeps its pace
//   model            a prediction that is not finite
//
// The first row is the zero. If the machine is warm then, that part of its error remains. If the second and the third
// row both contradict the first (spike), the first was wrong and the zero is set again.
//
// The offset is -error in the frame of the model's target, to be added to the command of the axis.
//
// next() allocates no memory. The whole state is in two values, that of the compensator and that of its model. They can
// be stored and resumed. After a restart the counts are those of before, and low passes cover the time in between in
// one step, with their inputs on a straight line.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct CompensationLimits {
  double resolution_um = 0.1;    // smallest increment of the control
  double hysteresis = 0.25;      // in increments, beyond one half
  double rate_um_per_s = 0.2;    // of the offset
  double step_um = 2.0;          // largest change of the offset from row to row; at least resolution_um
  double largest_um = 200.0;     // of |offset|
  double range_margin = 0.1;     // share of the trained range, added at either end
  double spike_K = 2.0;          // largest sudden change of a temperature
  double heating_K_per_s = 0.1;  // largest rate of change of a temperature
  double stuck_s = 1800.0;       // infinite: not checked
  double gap_s = 600.0;          // longest interval between rows
};

// Number of whole increments in a length, robust against rounding errors.
double whole_increments(double length_um, double resolution_um);

enum class Hold { none, no_value, spike, stuck, out_of_range, no_time, clock_back, clock_gap, model };
inline constexpr std::size_t kHoldKinds = 9;
std::string_view name_of(Hold hold);  // "no_value"
bool is_about_a_column(Hold hold);    // whether a sensor is the reason

struct Offset {
  std::int64_t counts = 0;    // the offset in increments
  double offset_um = 0.0;     // counts times resolution
  double predicted_um = 0.0;  // predicted error; NaN while held
  Hold hold = Hold::none;
  std::size_t column = 0;  // index into columns(), if a column is the reason
  bool limited = false;    // the offset has not reached the wanted value, or is at largest_um
};

class Compensator {
 public:
  // The state of a column; NaN before the first value. `believed` is the last accepted value, `read` the last reading.
  struct Sensor {
    double believed = std::numeric_limits<double>::quiet_NaN();
    double believed_s = std::numeric_limits<double>::quiet_NaN();
    double read = std::numeric_limits<double>::quiet_NaN();
    double unchanged_since_s = std::numeric_limits<double>::quiet_NaN();
  };
  struct State {
    double resolution_um = 0.0;  // of counts
    bool timed = false;          // a row has arrived
    bool started = false;        // a row has been accepted
    int believed = 0;            // accepted rows since the zero, at most 2
    int contradicted = 0;        // rows with spikes while only the row of the zero was accepted
    double time_s = 0.0;         // of the last row with a valid time, on the clock of the model
    double pace_s = 0.0;         // interval of the last two accepted rows
    double clock_s = 0.0;        // add to the time of a row for the clock of the model: how far it was set back
    double doubtful_s = std::numeric_limits<double>::quiet_NaN();  // a time that did not continue the clock
    double origin_um = 0.0;                                        // the model at the first row
    double offset_um = 0.0;                                        // before rounding to whole increments
    std::int64_t counts = 0;
    std::vector<Sensor> sensors;  // as columns()
  };

  // Takes a model with one target, with every parameter at its start, and its trained ranges. Throws Error: several
  // targets or one that is not in um, a trained range of a column that the model does not read, a model that cannot run
  // live (LiveModel), invalid limits.
  Compensator(const Model& model, const CompensationLimits& limits);

  // The columns that next() takes, in this order.
  std::span<const std::string> columns() const { return model_.columns(); }

  // The offset after this row. values: in the order of columns(); NaN where a sensor has no value.
  Offset next(double time_s, std::span<const double> values);

  const State& state() const { return state_; }
  const LiveModel& model() const { return model_; }

  // Restores a stored state. Throws Error if it is of another model or another resolution, if its offset exceeds
  // largest_um or does not fit its counts, if a required number is not finite, or if a row of the model is later than
  // the last row.
  void resume(const State& state, const LiveModel::State& model);

 private:
  struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
  };

  std::optional<double> follows(double time_s, Hold& why);
  void begin_anew(std::span<const double> values);
  Hold hold_of(std::size_t column, double time_s, double value) const;
  void walk(double wanted_um, double elapsed_s);
  Offset offset(Hold hold, std::size_t column, double predicted_um, bool limited) const;

  CompensationLimits limits_;
  LiveModel model_;
  std::vector<Range> ranges_;       // as columns(): accepted range
  std::vector<bool> temperatures_;  // as columns()
  State state_;
};

// ---- The compensators of all axes of a machine. All read the same row of signals.
//
// A model may read the prediction of another one, as bearing clearance depends on axial growth. If a column is not a
// signal but the target of an earlier axis, it takes the predicted error of that axis. This value is relative to the
// first row of that axis, so that the trained range of the measured column is not checked. While that axis is held,
// this one is held too (no_value).

struct CompensatedAxis {
  std::string name;  // "z"
  Model model;       // with one target
};

class CompensatedAxes {
 public:
  // Throws Error: no axis, a name twice, and the errors of Compensator, preceded by the axis.
  CompensatedAxes(const std::vector<CompensatedAxis>& axes, const CompensationLimits& limits);

  std::size_t size() const { return axes_.size(); }
  const std::string& name(std::size_t axis) const { return axes_[axis].name; }
  Compensator& axis(std::size_t axis) { return axes_[axis].compensator; }
  const Compensator& axis(std::size_t axis) const { return axes_[axis].compensator; }

  // The signals that the axes read, each once.
  std::span<const std::string> columns() const { return columns_; }

  // The offset of each axis, valid until the next call. values: in the order of columns(). Allocates no memory.
  std::span<const Offset> next(double time_s, std::span<const double> values);

 private:
  struct Source {
    bool predicted = false;  // the column is the prediction of another axis
    std::size_t index = 0;   // index of that axis, or into columns_
  };
  struct Axis {
    Axis(std::string of, const Model& model, const CompensationLimits& limits)
        : name(std::move(of)), compensator(model, limits) {}
    std::string name;
    Compensator compensator;
    std::vector<Source> sources;  // one per column of the compensator
    std::vector<double> values;
  };
  std::vector<std::string> columns_;
  std::deque<Axis> axes_;  // a deque, because a Compensator does not move
  std::vector<Offset> offsets_;
};

// ---- Replays a compensation over recorded signals: the error that would have remained with the model on line.
//
// There is a row at every time of a signal, in order. The value of a column is that of the last row of its own series,
// at most gap_s old; gaps stay gaps. The replay is causal: the error at a time is compensated by the offset of the last
// row before that time.
//
//   before_i = measured(t_i) - measured(t_0)
//   after_i  = before_i + offset(last row before t_i) - offset(last row before t_0)
//
// t_0 is the time of the first value of the target, where the machine is zeroed. That value is not part of RMS and
// largest error.

// The reduction of an error by a compensation, and its uncertainty.

// The size of n errors that is compared before and after.
enum class ErrorSize { mean_of_sizes, root_mean_square };

// share = 1 - size(after) / size(before); 0.7 means 70 % less. sigma comes from the delete-a-group jackknife with
// groups of `stretch` consecutive values. A group is twice as long as the lag at which the autocorrelation of the
// errors after falls below 0.2, at least 1 value and at most a fifth of all.
struct Reduction {
  double before_um = 0.0;
  double after_um = 0.0;
  double share = 0.0;  // NaN: no error before
  double sigma = 0.0;  // NaN: fewer than 3 values
  std::size_t stretch = 1;
};

// n >= 1 errors before and n errors after in um, pairwise, in order of time.
Reduction reduction_of(std::span<const double> before_um, std::span<const double> after_um, ErrorSize size);

struct ReplayedAxis {
  std::string name;
  std::string target;
  std::vector<double> time_s, before_um, after_um, offset_um;  // n values of the target, the first at t_0
  Reduction reduction;                                         // by the root mean square
  std::array<std::size_t, kHoldKinds> rows_held{};             // by Hold; rows under `none` were not held
  std::string most_held_by;                                    // the column that held most rows; empty: none
  std::size_t rows_limited = 0;
};

struct Replay {
  std::size_t rows = 0;
  std::vector<ReplayedAxis> axes;
};

// Throws Error: a column that no signal has (with the nearest name), a target that `measured` lacks or that has fewer
// than two values after the first row of the signals, and the errors of CompensatedAxes.
Replay replay_of(const std::vector<CompensatedAxis>& axes, const CompensationLimits& limits,
                 const std::vector<Series>& signals, const Series& measured);

// ---- A linear replacement for a model, simple enough for the built-in temperature compensation of a control.
//
//   K(T) = sum_j b_j (T_j - T0_j)        um, the error; one or a few sensors
//
// The slopes are a least squares fit to the predictions p of the model. In each run the zero is the row z of the first
// measured value, and the fit uses all rows from there on:
//
//   min_b  sum over runs and rows i of ((p_i - p_z) - sum_j b_j (T_ij - T_zj))^2
//
// The model restarts in each run, as it does live. No constant is fitted, because the machine is zeroed at the start of
// a run. T0, where K is 0, is the mean reading at these zeros. Of all sets of `count` sensors the one with the smallest
// sum is taken. Each T_j is limited to the range of its readings, widened by range_margin.
//
// The result is judged by the measured error y with the line as written, i.e. with rounded slopes and temperatures and
// K in whole increments:
//
//   after_i = (y_i - y_z) - (K(T_i) - K(T_z))
//
// It is judged on all values, and on values that were not used for choice and slopes: with several runs each run left
// out in turn, with one run the fourth and the fifth fifth of its time, each predicted from the time before.

// The slope of one sensor. Temperatures are in the unit of the column, degC or K.
struct SensorSlope {
  std::string column;
  double slope_um_per_K = 0.0;  // b, rounded to four decimals
  double sigma_um_per_K = 0.0;  // delete-one jackknife over the runs, or over the fifths of one run
  double zero = 0.0;            // T0, rounded to one decimal, as low and high
  double low = 0.0, high = 0.0;
};

// The smallest step of the offset in the control.
struct Increment {
  double um = 0.1;
  bool toward_zero = false;  // truncate to whole steps; false: round to the nearest
};

struct LinearCompensation {
  std::vector<SensorSlope> sensors;  // at least one
  Increment increment;
};

// K in um at these readings (one per sensor), in whole increments.
double error_um(const LinearCompensation& line, std::span<const double> readings);

// The error without compensation, with the full model, and with the line, on the same values.
struct LineErrors {
  Reduction model, line;
  double largest_um = 0.0;        // of the measured error since the zeros
  double largest_model_um = 0.0;  // of the error with the model
  double largest_line_um = 0.0;
  std::size_t values = 0;
  std::size_t beyond = 0;  // number of these with a reading outside low to high
};

struct Simplification {
  LinearCompensation line;
  std::size_t rows = 0;                // number of rows from the zeros on
  std::size_t runs = 0;                // number of runs with at least two values
  double from_model_um = 0.0;          // RMS of model minus line over these rows
  LineErrors fitted;                   // on all values
  std::optional<LineErrors> left_out;  // nullopt: a fifth has no value, or too small a temperature rise before it
};

inline constexpr std::size_t kMostLineSensors = 3;

// model: one target, all parameters held. candidates: temperature columns, of which `count` are chosen; constant ones
// are ignored. range_margin: share of the range of the readings, added at either end.
//
// Throws Error: several targets or one not in um, an unknown column, fewer than two values of the target in every run,
// fewer than `count` sensors that vary independently, a count of 0 or above kMostLineSensors, and the errors of
// predict().
Simplification simplified(const Model& model, const Series& data, std::span<const std::string> candidates,
                          std::size_t count, double range_margin, const Increment& increment);

}  // namespace ballbar

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

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/model/live_model.hpp"
#include "ballbar/model/model.hpp"

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

}  // namespace ballbar

// An offset for one axis of a machine, row by row as its sensors report: the negative of the error that a model
// predicts, made safe for a control.
//
//   error_i    = model(row i) - model(first row)        um; the row the machine is zeroed at
//   wanted_i   = - error_i
//   offset     goes towards wanted, by at most rate_um_per_s dt and at most step_um a row, within +- largest_um
//   counts     whole increments of resolution_um: kept while |offset - counts resolution| is at most
//              (1/2 + hysteresis) resolution, so that noise about the edge of an increment does not chatter
//
// A row whose sensors cannot be believed holds: counts stay, the model takes no notice of the row, and the reason is
// said. When the sensors are back the offset walks on at the same rate. What is held, each column of the model for
// itself:
//
//   no_value         a gap, NaN or infinity
//   spike            a temperature further from the last one believed than spike_K + heating_K_per_s times the time
//                    since: it is believed again once it is nearer, or the time has made it likely
//   stuck            a temperature that has been the same to the last digit for stuck_s in which rows came
//   out_of_range     outside of what the model was trained on (Model::trained), widened by range_margin of its span
//                    at either end. A column without a trained range is not looked at
//   no_time          a time that is no number, or more than 1e12 s from 0
//   clock_back       a time not after the last one. The new clock is believed with the next row that follows on it:
//                    the time between is then 0
//   clock_gap        a time more than gap_s after the last one, and more than twice what passed before that: believed
//                    with the next row that follows on it, or that keeps its pace
//   model            a prediction that is not finite
//
// The first row is the zero: a machine that is warm then keeps that part of its error. Where the second and the third
// row both contradict it (spike), it was the first that was wrong, and the zero is set anew.
//
// The offset is - error in the frame of the model's target: what is added to the axis' command.
//
// next() takes no memory. All that is known from row to row is in two values, that of the compensator and that of its
// model, which can be stored and gone on from: after a restart the counts are those of before, and low passes go
// through the time between in one step, their inputs on a straight line.
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
  double resolution_um = 0.1;    // least increment of the control
  double hysteresis = 0.25;      // of an increment, beyond the half
  double rate_um_per_s = 0.2;    // of the offset
  double step_um = 2.0;          // of the offset from one row to the next; not below resolution_um
  double largest_um = 200.0;     // of |offset|
  double range_margin = 0.1;     // of a trained range, at either end
  double spike_K = 2.0;          // at once,
  double heating_K_per_s = 0.1;  // and with the time
  double stuck_s = 1800.0;       // infinite: not looked for
  double gap_s = 600.0;          // between rows
};

// Whole increments in a length, without losing one to rounding.
double whole_increments(double length_um, double resolution_um);

enum class Hold { none, no_value, spike, stuck, out_of_range, no_time, clock_back, clock_gap, model };
inline constexpr std::size_t kHoldKinds = 9;
std::string_view name_of(Hold hold);  // "no_value"
bool is_about_a_column(Hold hold);    // a sensor is why

struct Offset {
  std::int64_t counts = 0;    // the offset in increments
  double offset_um = 0.0;     // counts times resolution
  double predicted_um = 0.0;  // the error; NaN while held
  Hold hold = Hold::none;
  std::size_t column = 0;  // of columns(), for the holds that are about one
  bool limited = false;    // still on its way to what is wanted, or stopped at largest_um
};

class Compensator {
 public:
  // What a column was: NaN before the first value.
  struct Sensor {
    double believed = std::numeric_limits<double>::quiet_NaN();
    double believed_s = std::numeric_limits<double>::quiet_NaN();
    double read = std::numeric_limits<double>::quiet_NaN();
    double unchanged_since_s = std::numeric_limits<double>::quiet_NaN();
  };
  struct State {
    double resolution_um = 0.0;  // of counts
    bool timed = false;          // a row has come
    bool started = false;        // a row has been believed
    int believed = 0;            // rows since the zero, 2 at most
    int contradicted = 0;        // rows that were spikes while only that of the zero was believed
    double time_s = 0.0;         // of the last row that followed on one, on the clock of the model
    double pace_s = 0.0;         // between the last two rows that were believed
    double clock_s = 0.0;        // what to add to a row's time for that clock: by how much it was set back
    double doubtful_s = std::numeric_limits<double>::quiet_NaN();  // a row's time that did not follow
    double origin_um = 0.0;                                        // the model at the first row
    double offset_um = 0.0;                                        // before it is made whole increments
    std::int64_t counts = 0;
    std::vector<Sensor> sensors;  // as columns()
  };

  // One target, every parameter at its start, the model's trained ranges. Throws Error: more than one target or one
  // that is not in um, a trained range of a column that the model does not read, a model that cannot run live
  // (LiveModel), limits that make no sense.
  Compensator(const Model& model, const CompensationLimits& limits);

  // What next() wants, in this order.
  std::span<const std::string> columns() const { return model_.columns(); }

  // values: as many as columns(); NaN where a sensor gives none.
  Offset next(double time_s, std::span<const double> values);

  const State& state() const { return state_; }
  const LiveModel& model() const { return model_; }

  // Goes on from there. Throws Error where it is the state of another model, of another resolution, of an offset beyond
  // largest_um or further from its counts than they can be, holds a number that is not finite where it must be, or a
  // row of the model after the last row.
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
  std::vector<Range> ranges_;       // as columns(): what is believed
  std::vector<bool> temperatures_;  // as columns()
  State state_;
};

}  // namespace ballbar

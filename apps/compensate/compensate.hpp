// The ways of `ballbar compensate` with a model.
#pragma once

#include <string>
#include <vector>

#include "compensate/compensation_options.hpp"

namespace ballbar {

// --signals: offsets row by row as rows arrive.
enum class OffsetFormat { csv, jsonl, word };

struct LiveOptions {
  std::string signals;  // file, or "-": the standard input
  bool follow = false;  // wait for what is yet to be written to the file
  OffsetFormat format = OffsetFormat::csv;
};

// Offsets to the standard output, what is held and goes on to the standard error. Ends with the signals, or with
// SIGINT or SIGTERM after the row at hand; the state is kept. Throws Error: axes_of, the first line of the signals, a
// state of other axes, an output that nobody reads any more, a followed file that became shorter.
void compensate_live(const CompensationOptions& options, const LiveOptions& live);

// --on: what the error would have been with the model on line.
struct ReplayOptions {
  Source data;  // a session, or a series with its signals
  std::vector<std::string> out;
  bool json = false;
};

void compensate_replay(const CompensationOptions& options, const ReplayOptions& replay);

// --write: a straight line in place of the model, as a file for a control's own temperature compensation, and what that
// costs.
struct WriteOptions {
  std::string control;           // "siemens", "siemens:2", "siemens:T_a_degC,T_b_degC"; empty: nothing is written
  Source data;                   // what the model is looked at on
  std::vector<std::string> out;  // one, of the control's ending
  bool reversed = false;         // the sign
  bool json = false;
};

// Throws Error as simplified(), control_of() and axes_of(); nothing is written then.
void compensate_write(const CompensationOptions& options, const WriteOptions& write);

}  // namespace ballbar

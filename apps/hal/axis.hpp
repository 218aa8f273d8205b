// One axis: converts the wanted offset of its model to changes of the counts for LinuxCNC. Independent of HAL.
//
// LinuxCNC does not take axis.L.eoffset-counts as a position. It adds the *change* of the counts times
// eoffset-scale to its offset, and only while the machine is on, homed and eoffset-enable is true; a change at another
// time is lost. When the machine is turned on, the offset starts at zero, whatever the counts are (2.9, observed in
// tests/hal/machine.py). Counts that simply follow the model would therefore give a wrong offset after the machine
// was turned off and on. So
//
//   in force = eoffset-request / scale        what the control has
//   change   = wanted - in force              wanted: the compensator's, walking from what is in force at its own rate
//
// and counts are only ever changed by `change`, never set.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "ballbar/compensation/compensation.hpp"

namespace ballbar::hal {

// The numbers of the pin hold-reason, which must not change. 1 to 8 are those of Compensator; of several the first.
enum class Reason {
  none = 0,
  no_value = 1,
  spike = 2,
  stuck = 3,
  out_of_range = 4,
  clock_back = 5,
  clock_gap = 6,
  model = 7,
  no_time = 8,
  disabled = 9,  // the pin `enable` is false, or was at the last row
  control = 10   // the control has another offset than it was given: for one row, then it is gone on from; or none that
                 // is known, or a larger one than ours can be: for as long as that is so
};
Reason reason_of(Hold hold);
const char* name_of(Reason reason);  // "no_value"

struct Pins {
  bool enable = false;
  double applied_mm = 0.0;  // axis.L.eoffset-request, whatever the machine's unit; NaN: not connected
};

struct Step {
  bool enable = false;      // axis.L.eoffset-enable: a row later than the pin `enable`, when all pins are connected
  std::int64_t change = 0;  // of counts
  Offset offset;            // .counts are those in force when the change is taken up
  Reason reason = Reason::none;
};

// One row: begin(), next() of the compensator, end(). The compensator also follows its sensors while the offset is
// held, so that its memory is right afterwards.
class Axis {
 public:
  explicit Axis(const CompensationLimits& limits);

  void begin(const Pins& pins, Compensator& compensator);
  Step end(const Offset& offset, Compensator& compensator);

  double scale_mm() const { return resolution_um_ / 1000.0; }  // of a count

 private:
  std::optional<std::int64_t> read(const Pins& pins) const;
  void resume_in_force(Compensator& compensator) const;

  double resolution_um_, largest_um_;
  double most_counts_;  // whole ones in largest_um_
  std::optional<std::int64_t> in_force_;
  bool doubt_ = false;    // at this row the control has a different offset than requested
  bool doubted_ = false;  // likewise at the last row
  bool enable_ = false;   // the pin was true at this row and the last one
  bool enabled_ = false;  // at this one
};

}  // namespace ballbar::hal

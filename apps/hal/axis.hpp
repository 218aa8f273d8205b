// One axis: from what its model wants to the increments that LinuxCNC must still be given. No HAL here.
//
// LinuxCNC does not take axis.L.eoffset-counts as a position. It adds the *change* of the counts times
// eoffset-scale to its offset, and only while the machine is on, homed and eoffset-enable is true; a change at another
// time is lost. When the machine is turned on the offset begins at zero again whatever the counts are (2.9, seen in
// tests/hal/machine.py). Counts that simply follow the model would therefore leave an offset wrong by its whole
// size after the machine was off and on once. So
//
//   in force = eoffset-request / scale        what the control has
//   change   = wanted - in force              wanted: the compensator's, walking from what is in force at its own rate
//
// and counts are only ever changed by `change`, never set.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "ballbar/compensation.hpp"

namespace ballbar::hal {

// The numbers of the pin hold-reason; they stay as they are. 1 to 7 are those of Compensator, first in the list of
// what is wrong.
enum class Reason {
  none = 0,
  no_value = 1,
  spike = 2,
  stuck = 3,
  out_of_range = 4,
  clock_back = 5,
  clock_gap = 6,
  model = 7,
  disabled = 8,  // the pin `enable` is false, or was at the last row
  control = 9    // the control has another offset than it was given: for one row, then it is gone on from; or none that
                 // is known, or a larger one than ours can be: for as long as that is so
};
Reason reason_of(Hold hold);
const char* name_of(Reason reason);  // "no_value"

struct Pins {
  bool enable = false;
  double applied_mm = 0.0;  // axis.L.eoffset-request; NaN: not connected
};

struct Step {
  bool enable = false;      // axis.L.eoffset-enable: a row later than the pin `enable`, when all pins are connected
  std::int64_t change = 0;  // of counts
  Offset offset;            // .counts are those in force when the change is taken up
  Reason reason = Reason::none;
};

class Axis {
 public:
  // Throws Error as Compensator.
  Axis(char letter, const Model& model, const CompensationLimits& limits)
      : letter_(letter), resolution_um_(limits.resolution_um), largest_um_(limits.largest_um), wanted_(model, limits) {}

  // The model follows its sensors while the offset is held, too: what it knows of the past is then right afterwards.
  Step next(double time_s, std::span<const double> values, const Pins& pins);

  char letter() const { return letter_; }
  double scale_mm() const { return resolution_um_ / 1000.0; }  // of a count
  const Compensator& compensator() const { return wanted_; }
  Compensator& compensator() { return wanted_; }

 private:
  std::optional<std::int64_t> read(const Pins& pins) const;
  void begin_at(std::int64_t counts);

  char letter_;
  double resolution_um_, largest_um_;
  Compensator wanted_;
  std::optional<std::int64_t> in_force_;
  bool doubted_ = false;  // the last row found another offset than was given
  bool enabled_ = false;  // the pin was true at the last row
};

}  // namespace ballbar::hal

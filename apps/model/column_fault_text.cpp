#include "model/column_fault_text.hpp"

#include <fmt/format.h>

#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {

std::string what_text(const ColumnFault& fault) {
  const bool one = fault.count == 1;
  switch (fault.kind) {
    case FaultKind::pauses:
      return fmt::format("{} {} of more than {:g} s, the longest of {:g} s at {:g} s", fault.count,
                         one ? "pause" : "pauses", fault.long_s, fault.value, fault.at_s);
    case FaultKind::few_values:
      return "has fewer than three values";
    case FaultKind::gaps:
      return fmt::format("{:.0f} % gaps", 100.0 * fault.value);
    case FaultKind::constant:
      return fmt::format("does not change: {:g} in all rows", fault.value);
    case FaultKind::stuck:
      return fmt::format("does not change any more in the last {} rows: {:g}", fault.count, fault.value);
    case FaultKind::far_off:
      if (one) {
        return fmt::format("a reading, {:g} at {}, lies far off its neighbours", fault.value,
                           duration_text(fault.at_s));
      }
      return fmt::format("{} readings lie far off their neighbours, the first, {:g}, at {}", fault.count, fault.value,
                         duration_text(fault.at_s));
    case FaultKind::clipped:
      return fmt::format("stays at its {} value, {:g}, for {} in all (clipped?)", fault.is_low ? "lowest" : "highest",
                         fault.value, duration_text(fault.long_s));
    case FaultKind::jumps:
      return fmt::format("jumps at least {} times, by {:.2g}, the first time at {}", fault.count, fault.value,
                         duration_text(fault.at_s));
  }
  return {};
}

std::string fault_text(const ColumnFault& fault) {
  return fmt::format("{}: {}.", fault.column.empty() ? "Time" : fault.column, what_text(fault));
}

std::string lines_of(const std::vector<ColumnFault>& faults) {
  std::string lines;
  for (const ColumnFault& fault : faults) lines += wrapped(fault_text(fault));
  return lines;
}

Message sentence_of(const SensorJump& jump) {
  const std::string size = fmt::format("{:.2g} {}", jump.size, unit_of(jump.column)), time = duration_text(jump.time_s);
  if (jump.run.empty()) return messages::sensor_jump(jump.column, size, time);
  return messages::sensor_jump(jump.column, size, messages::time_of_run(time, jump.run));
}

}  // namespace ballbar

// `--leave-out-times FROM..TO`: readings to ignore, such as those while a door of the machine was open.
#pragma once

#include <string>
#include <vector>

#include "ballbar/formats/sessions/data_file.hpp"

namespace CLI {
class App;
}

namespace ballbar {

// Both ends included. With several runs, times of the runs end to end, as the page draws them.
struct TimeRange {
  double from_s = 0.0, to_s = 0.0;
  bool operator==(const TimeRange&) const = default;
};

// "3600 s to 7200 s"
std::string text_of(const TimeRange& range);

void add_left_out_times(CLI::App& command, std::vector<TimeRange>& left_out);

// The data without the measured values within these times. The inputs of effects stay, so that effects with memory
// continue. Throws Error for recordings, and for times without measured values.
ModelData without_times(ModelData data, const std::vector<TimeRange>& left_out);

}  // namespace ballbar

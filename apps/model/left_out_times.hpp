// `--leave-out-times FROM..TO`: readings that are not to be explained, such as those while the machine stood open.
#pragma once

#include <string>
#include <vector>

#include "ballbar/formats/sessions/data_file.hpp"

namespace CLI {
class App;
}

namespace ballbar {

// Both ends included. Of several runs in the time of one after the other, as the page draws them.
struct TimeRange {
  double from_s = 0.0, to_s = 0.0;
  bool operator==(const TimeRange&) const = default;
};

// "3600 s to 7200 s"
std::string text_of(const TimeRange& range);

void add_left_out_times(CLI::App& command, std::vector<TimeRange>& left_out);

// The data without the measured values within these times. What effects read there stays, so that one with a memory
// goes on through them. Throws Error for recordings, and for times within which nothing was measured.
ModelData without_times(ModelData data, const std::vector<TimeRange>& left_out);

}  // namespace ballbar

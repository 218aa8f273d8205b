// Combines the findings in the quantities of one machine: one event per date, one trend per cause.
#pragma once

#include <vector>

#include "history/calls.hpp"
#include "history/quantity_series.hpp"

namespace ballbar {

struct Event {
  FindingKind kind = FindingKind::step;
  std::vector<const Call*> calls;  // the most significant first
  double from_s = 0.0, to_s = 0.0;
  std::optional<int> axis;
  bool is_common_scale = false;
  bool to_the_worse = false;  // at least two kinds of errors, most of them farther from 0 than before
  std::string bar_before, bar_after;
};

// Steps whose dates agree are one event:
//   instrument      only scales step, all by the same amount, when the serial number of the bar changes
//   replaced_part   at least two kinds of errors of one axis, all nearer to 0 than before; no error of another axis and
//                   no squareness is farther from 0
//   step            all others
// Trends are one event for each axis and kind of error; all seasons are one.
std::vector<Event> events_of(const AllSeries& all, const std::vector<const Call*>& calls);

}  // namespace ballbar

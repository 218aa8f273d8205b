// Findings of one machine from what was found in its quantities: one event a date, one wear a cause.
#pragma once

#include <vector>

#include "history/calls.hpp"
#include "history/quantity_series.hpp"

namespace ballbar {

struct Event {
  FindingKind kind = FindingKind::step;
  std::vector<const Call*> calls;  // the clearest first
  double from_s = 0.0, to_s = 0.0;
  std::optional<int> axis;
  bool is_common_scale = false;
  bool to_the_worse = false;  // two kinds of errors at least, most of them farther from 0 than before
  std::string bar_before, bar_after;
};

// Steps whose dates agree are one event:
//   instrument      scales alone step, all by as much, where the bar's serial number changes
//   replaced_part   two kinds of errors of one axis at least, all nearer to 0 than before, and none of another axis or
//                   of the angle of the axes farther
//   step            all others
// Trends are one event for each axis and kind of error; all seasons are one.
std::vector<Event> events_of(const AllSeries& all, const std::vector<const Call*>& calls);

}  // namespace ballbar

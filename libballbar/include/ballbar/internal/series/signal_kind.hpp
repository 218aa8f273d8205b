// How the values of a column move. The values decide; the name only translates.
#pragma once

#include <span>

namespace ballbar {

enum class SignalKind {
  still,    // one value, or none
  counter,  // row numbers, seconds, dates: tells where in the record a row stands, drives nothing
  steps,    // held and switched: speed, door, pump, tool number; between rows the last value holds
  smooth,   // temperature, level: between rows a straight line
};

// Of the values in the order of the rows; NaN is ignored. A change is the difference of two neighbours.
// counter: at least three rises, never a fall, and at most two sizes of change to 1e-9 of the range. No change is a
//   size too. Where it is one, there are at least 10 rises at about equal distances: the inner runs of equal values
//   differ by a factor of 2 and one row at most. So a single switch, a staircase of few speeds and a sensor of coarse
//   resolution that warms up are no counters; the number of a day is none before the eleventh day.
// steps: two values, however often they change, or fewer than 15 % of the changes exceed 3 % of the range, and these
//   make more than half of all movement.
// O(n).
SignalKind signal_kind(std::span<const double> values);

// Whether it is steps or smooth.
bool may_drive(std::span<const double> values);

}  // namespace ballbar

// What a `.b5r` stores of the circles of its runs: AF_CENTRE_OFFSET_A, AF_CENTRE_OFFSET_B and AF_BEST_RADIUS, through
// the polar points, written to 0.1 um.
#pragma once

#include <vector>

#include "ballbar/circle/circle_fit.hpp"
#include "ballbar/circle/recording.hpp"
#include "ballbar/formats/recordings/b5r.hpp"

namespace ballbar {

struct StoredCircle {
  Recording recording;  // without readings: plane, direction, nominal length, start
  Circle circle;        // its covariance is not known: NaN
};

// One a run that stores all three; a run without a direction is called CCW.
std::vector<StoredCircle> stored_circles(const B5r& test);

}  // namespace ballbar

// A finite-volume spindle with a duty cycle to train on and another to predict.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar::predictions {

// As logged, and what there was: every sensor without noise and every cause of the tip's motion.
struct Duty {
  Series logged;  // with the target
  Series truth;   // columns as of ThermalRun::sensors and ::truth
};

// Spindles of one build whose numbers differ by a fifth, 8 h of random steps of speed to train on and 6 h of others, in
// a room that wanders. Every second spindle's temperatures are rounded to 0.1 K, the others know them to 0.01 K. The
// target is x, y or z in turn, with 0.15 um of independent noise and 0.4 um that forget in 10 min; in every third
// spindle also a discrepancy of 1 um that forgets in 2 h and that no column knows.
struct Made {
  std::string target;
  bool rounded = false, discrepant = false;
  Duty training, unseen;
};

Made made(std::uint64_t seed);

// Runs of one spindle of that build, each with a duty of its own; temperatures to 0.01 K, no discrepancy.
std::vector<Series> runs_of(std::uint64_t seed, std::size_t count, double hours, const std::string& target);

// The columns of a training, and a target that is a random walk of its own with steps of 0.3 um.
Series random_walk(const Made& of, std::uint64_t seed);

}  // namespace ballbar::predictions

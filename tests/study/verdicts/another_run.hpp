// A set with the machine that it came from, which can be run again.
#pragma once

#include "scene.hpp"

namespace ballbar::verdicts {

struct Bench {
  Made made;
  Scene scene;
  std::vector<Hidden> hidden;  // gains included
};

// The set that made() makes, without what rivals could make of it (ideal_p, rival).
Bench bench_of(const Recipe& recipe, std::string_view stream, std::uint64_t seed);

// Where a temperature at which something happens (a kink, a viscosity) is known from.
enum class Places {
  machine,  // it stays where it was
  own,      // its rise above the first temperature of the run, whatever that is
};

// The same machine with the same hidden effects under a schedule, logged by the same logger, clocks as late as before,
// columns in the same order; a row every reading_s, 0: as often as before. Of the set-up a new offset.
Series next_run(const Bench& bench, const Schedule& schedule, Places places, Chance& chance);

}  // namespace ballbar::verdicts

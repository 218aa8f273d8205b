// What the benchmarks work on, made by the simulator: the same seed, the same bytes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/lab/simulation/simulate.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar::bench {

// One full circle about an offset centre.
Recording circle_of(std::size_t readings);

// A test as the instrument stores it: CCW and CW, 1500 readings each.
std::string b5r_bytes();

// The test of that week of a machine: planes in turn, two runs of 1500 readings, backlash that grows.
std::string b5r_of_week(int week);

// A ballbar log of at least that many bytes: one circle of 100 000 readings over and over.
std::string log_bytes(std::size_t size);

// Five probes every 15 s over a warm-up, 0.1 um of noise, printed to 0.01 um; spacing and resolution stated.
Series five_probe_series(std::size_t rows);

// Warm-ups by 15 to 35 K in rooms of 10 to 30 degC: 600 rows of 24 temperatures, to 0.1 K, the last the room's, and
// z_um, whose slope on them changes with the room.
std::vector<Series> warm_ups(std::size_t count);

// 15 tests of two arcs, 1500 and 800 readings, over four hours.
SimulatedSession two_arc_session();

}  // namespace ballbar::bench

// What a `.b5r` stores of the errors of the machine (analysis RENISHAW_DIAGNOSTICS), by the names of
// machine_errors.hpp; and of the circles of its runs.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "ballbar/circle/circle_fit.hpp"
#include "ballbar/circle/recording.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"

namespace ballbar {

// Of a row, "backlash_a_pos"; nothing where the file stores none or calls it not valid.
std::optional<double> stored_error(const B5r& test, std::string_view row);

// Of an effect, "backlash_a": its place among the software's, and its own circularity in um.
std::optional<int> stored_rank(const B5r& test, std::string_view effect);
std::optional<double> stored_individual_circularity_um(const B5r& test, std::string_view effect);

// Pitch of the screw of axis A or B that its cyclic error was looked for with.
std::optional<double> stored_pitch_mm(const B5r& test, char axis);

// How a test is fitted so that the file's values can stand beside: what a cyclic error of both runs is.
MachineErrorOptions error_options(const B5r& test);

// Whether the software takes the mean of both runs for a cyclic error (versions before 20), not the larger.
bool stores_cyclic_means(const B5r& test);

// What it stores of the circles of its runs: AF_CENTRE_OFFSET_A, AF_CENTRE_OFFSET_B and AF_BEST_RADIUS, through the
// polar points, written to 0.1 um.
struct StoredCircle {
  Recording recording;  // without readings: plane, direction, nominal length, start
  Circle circle;        // its covariance is not known: NaN
};

// One a run that stores all three; a run without a direction is called CCW.
std::vector<StoredCircle> stored_circles(const B5r& test);

}  // namespace ballbar

// The errors of the machine stored in a `.b5r` (analysis RENISHAW_DIAGNOSTICS), by the names of machine_errors.hpp, and
// the stored circles of its runs.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "ballbar/circle/circle.hpp"
#include "ballbar/circle/recording.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"

namespace ballbar {

// The stored value of a row, "backlash_a_pos"; nullopt: not stored or not valid.
std::optional<double> stored_error(const B5r& test, std::string_view row);

// The rank of an effect, "backlash_a", in the software's list, and its individual circularity in um.
std::optional<int> stored_rank(const B5r& test, std::string_view effect);
std::optional<double> stored_individual_circularity_um(const B5r& test, std::string_view effect);

// The pitch of the screw of axis A or B that the software used for its cyclic error.
std::optional<double> stored_pitch_mm(const B5r& test, char axis);

// Options for machine_errors() that make its values comparable with those of the file.
MachineErrorOptions error_options(const B5r& test);

// Whether the software stores the mean of both runs as the cyclic error (versions before 20) or the larger one.
bool stores_cyclic_means(const B5r& test);

// The stored circle of a run: AF_CENTRE_OFFSET_A, AF_CENTRE_OFFSET_B and AF_BEST_RADIUS, a circle through the polar
// points, rounded to 0.1 um.
struct StoredCircle {
  Recording recording;  // without readings: plane, direction, nominal length, start
  Circle circle;        // with unknown covariance (NaN)
};

// One for each run that stores all three values; a run without a direction counts as CCW.
std::vector<StoredCircle> stored_circles(const B5r& test);

}  // namespace ballbar

// Circles exported by other instruments and controls, as a table of text. The format is recognised by the numbers,
// whatever the header: two coordinates that lie on a circle (grid encoders such as KGM, circularity tests of CNCs), or
// an angle with a radius, a length or a deviation. An arc may have any length from 10 deg; below 150 deg its columns
// are named, or from 60 deg on those of a table without names, it is swept steadily, and no column is a temperature or
// a load.
//
// Separators, decimal signs and encodings are those of a log (log.hpp). The runs of both directions follow one another,
// or are two columns of radius with CCW and CW in their names. Coordinates count from the centre of their circle,
// unless it is within a hundredth of the radius from their zero. Readings at standstill before and after a run, and
// points off the circle by more than a fiftieth of the radius (feed-in and feed-out), are left out.
//
// Units are those of the header. Without a unit an angle is in deg, or in rad if it runs to 2 pi; lengths are in mm, or
// in um if above 2000; deviations are in mm if they spread over less than 0.3, else in um.
#pragma once

#include <optional>
#include <string_view>

#include "ballbar/formats/recordings/recording_file.hpp"

namespace ballbar {

// Whether the first bytes of a file hold a circle.
bool holds_circle(std::string_view head);

// The recordings, with a remark on how they were read. Throws Error with `name`: no circle, or a nominal radius that is
// neither in the header nor stated.
RecordingFile read_circle_table(std::string_view bytes, std::string_view name, const StatedCircle& stated);

}  // namespace ballbar

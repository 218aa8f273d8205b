// A circle as other instruments and controls export it: a table of text whose numbers are a circle. It is known by
// what the numbers are, whatever the header: two coordinates that lie on a circle (grid encoders such as KGM, the
// circularity tests of CNCs), or an angle that runs through a turn beside a radius, a length or a deviation.
//
// Separators, decimal signs and encodings are those of a log (log.hpp). Runs of both directions may follow each other,
// or stand as two columns of radius whose names say CCW and CW. Coordinates are taken from the centre of their circle
// unless that is within a hundredth of the radius of their zero. Readings that stand still before and after a run, and
// points off the circle by more than a fiftieth of its radius (the way in and out), are left out.
//
// Units are those of the header. Without one an angle is in deg or, where it runs to 2 pi, in rad; lengths are in mm,
// above 2000 in um; deviations that spread over less than 0.3 are in mm, others in um.
#pragma once

#include <optional>
#include <string_view>

#include "ballbar/formats/recordings/recording_file.hpp"

namespace ballbar {

// Whether the first bytes of a file hold a circle.
bool holds_circle(std::string_view head);

// The recordings, and a remark that says how they were read. Throws Error with `name`: no circle, or one whose nominal
// radius is neither in the header nor stated.
RecordingFile read_circle_table(std::string_view bytes, std::string_view name, const StatedCircle& stated);

}  // namespace ballbar

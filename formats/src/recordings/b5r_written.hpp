// Helpers to write the parts of a `.b5r`.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "ballbar/formats/recordings/b5r.hpp"

namespace ballbar {

using Out = std::back_insert_iterator<fmt::memory_buffer>;

// START_ANGLE and END_ANGLE, deg, in [0, 360), counter-clockwise; equal for a full circle.
struct Sweep_deg {
  double start = 0.0;
  double arc = 360.0;
  double end = 0.0;
};

// Of n readings over that arc at the recording's feed.
double sample_rate_Hz(const Recording& run, double arc_deg);

// Text as it stands in XML.
std::string escaped(std::string_view text);

// "ISO230_4 2005" as NAME="ISO230_4" version="2005".
std::string analysis_attributes(std::string_view parent);

// TEST_SPEC; `sweep` is that of the recordings, where there are any.
void write_spec(Out to, const B5r& test, const Sweep_deg& sweep);

// From OPERATOR to EQUIPMENT.
void write_head(Out to, const B5r& test);

}  // namespace ballbar

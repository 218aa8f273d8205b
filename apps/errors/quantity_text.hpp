// How quantities, dates and errors are written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "ballbar/circle/recording.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

std::string date_text(double time_s);                           // "2025-09-04"
std::string iso_date_text(std::int64_t time_s);                 // "2025-09-04T16:10:49"
std::string several(std::size_t count, std::string_view what);  // "1 test", "2 tests"

std::string signed_text(double value, int decimals);

enum class FirstLetter { small, capital };

// Readable names of the errors of a machine: the axes a and b of the catalogue become X and Y in the plane XY, and
// reversal_spike_a becomes "reversal spike of X".
Message error_of(std::string_view effect, Plane plane, FirstLetter first = FirstLetter::small);
std::string plain_name(std::string_view effect, Plane plane);

// "Axis A moves sideways, along B": the catalogue's summaries, where a word that is A or B is an axis.
std::string with_axes(std::string_view summary, Plane plane);
Message summary_of(const Effect& effect, Plane plane);  // within a sentence

// "Free expansion with one temperature." as a part of another sentence: "free expansion with one temperature".
std::string within_sentence(std::string sentence);

// "Measure the other direction."
Paragraph message_of(const NextMeasurement& next);

}  // namespace ballbar

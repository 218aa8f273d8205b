// Rows of offsets as text: CSV, JSON lines, 16-bit words.
//
//   csv     time_s, then of every axis: _um the offset, _counts, _predicted_um the error (empty while held),
//           _limited 1 where it is on its way or at its largest, _hold the reason, "none"
//   jsonl   {"time_s":12,"z":{"offset_um":-3.1,"counts":-31,"predicted_um":3.12,"limited":false,"hold":"none"}}, with
//           "column" where a column is why
//   word    time_s, then of every axis _word, 0 to 65535, and _hex: the counts in two's complement on 16 lines, bit 0
//           the least, and _status, the reason of a hold as a number (Hold of compensation.hpp, 0 none) and 16 more
//           where it is limited: what a PLC hands to the external shift of a control's machine coordinates, whose least
//           increment is the resolution. -1 is 65535, 0xFFFF. An offset is at most 32767 counts
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "ballbar/compensation/compensation.hpp"

namespace ballbar {

constexpr double kLargestWord = 32767.0;

// "2 no_value, 1 spike" of rows by Hold; empty where none was held.
std::string held_text(const std::array<std::size_t, kHoldKinds>& rows);

// "91.9 ± 2.2", how many percent less is left; "?" where nothing was there before.
std::string percent_text(const Reduction& reduction);

void append_csv_names(fmt::memory_buffer& out, const CompensatedAxes& axes);
void append_csv(fmt::memory_buffer& out, double time_s, std::span<const Offset> offsets);
void append_jsonl(fmt::memory_buffer& out, double time_s, std::span<const Offset> offsets, const CompensatedAxes& axes);
void append_word_names(fmt::memory_buffer& out, const CompensatedAxes& axes);
void append_words(fmt::memory_buffer& out, double time_s, std::span<const Offset> offsets);

}  // namespace ballbar

// How quantities, tolerances, dates and groups are written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "ballbar/history/history.hpp"

namespace ballbar {

std::string date_text(double time_s);                           // "2025-09-04"
std::string iso_date_text(std::int64_t time_s);                 // "2025-09-04T16:10:49"
std::string group_text(const TestGroup& group);                 // "XY, 100 mm, 1000 mm/min, 360 deg"
std::string csv_text(const std::string& text);                  // in quotes where it needs them
std::string csv_number(double value);                           // empty: not finite
std::string several(std::size_t count, std::string_view what);  // "1 test", "2 tests"

int decimals_of(const std::string& unit);
std::string signed_text(double value, int decimals);

// Cells of a table; "-" where there is nothing to state.
std::string tolerance_text(const Tolerance& tolerance);  // "± 5"
std::string outlook_text(const ToleranceOutlook& one);   // "2027-03-01 (2026-11-05 to 2027-10-20)"

std::string_view name_of(Outlook outlook);  // as in JSON: "expected"

// The outlook of a series; nullptr: it has no tolerance.
const ToleranceOutlook* outlook_for(const MachineHistory& machine, std::size_t series);
// Whether a finding of such a kind names the series.
bool is_found(const MachineHistory& machine, std::size_t series, bool lasting);

}  // namespace ballbar

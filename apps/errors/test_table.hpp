// Tests as a table: one row per test, with every error and its sigma.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "errors/test_files.hpp"

namespace ballbar {

// file, machine, bar, date, plane, length_mm, feed_mm_per_min, start_deg, arc_deg, stored; then each quantity of any of
// the tests, NAME_UNIT, and NAME_sigma_UNIT. Empty: not known, or not one of that test's.
std::string test_table_csv(const std::vector<MachineTest>& tests);

// "scale_mismatch_um", "squareness_um_per_m".
std::string column_name(const TestQuantity& quantity, bool of_sigma = false);

// nullptr: the test has none of this name.
const TestQuantity* quantity_of(const MachineTest& test, std::string_view name);

// The larger end of the error to correct first; nullptr: none.
const TestQuantity* first_to_mend(const MachineTest& test);

// "2025-09-04 to 2026-01-12", or the only date; empty: none is stated.
std::string dates_text(const std::vector<MachineTest>& tests);

// For the terminal.
std::string test_table_text(const TestFiles& files, bool details = false);  // details: all rows

}  // namespace ballbar

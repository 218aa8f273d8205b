// What `errors --json` prints: tests, each with its errors, and the files that have none of their own.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/history/history.hpp"
#include "errors/quantity_text.hpp"
#include "errors/test_files.hpp"

namespace ballbar {

inline std::optional<std::string> moment_of(const std::optional<std::int64_t>& time_s) {
  return time_s ? std::optional(iso_date_text(*time_s)) : std::nullopt;
}

template <>
inline constexpr auto kResult<SkippedTest> = ResultType{
    "SkippedTest", "A file that has no test of its own.",
    std::tuple{Field{"file", &SkippedTest::file, ""}, Field{"sentence", &SkippedTest::sentence, "with the file's name"},
               Field{"copy_of", &SkippedTest::copy_of, "file of whose test it is one; null: none"}}};

template <>
inline constexpr auto kResult<TestQuantity> = ResultType{
    "TestQuantity", "An error, or a quantity, of a test.",
    std::tuple{Field{"name", &TestQuantity::name, ""}, Field{"value", &TestQuantity::value, ""},
               Field{"sigma", &TestQuantity::sigma, "null: not known"}, Field{"unit", &TestQuantity::unit, ""},
               Field{"significant", &TestQuantity::significant, "whether the test shows it"},
               Field{"rank", &TestQuantity::rank, "by the gain of its repair, 1 the largest; null: none"},
               Field{"of_set_up", &TestQuantity::of_set_up, "it says nothing of the machine"}}};

inline constexpr auto kMachineTestMadeWith =
    std::tuple{Field{"file", &MachineTest::file, ""},
               Field{"second_file", &MachineTest::second_file, "log of the other direction; empty: none"},
               Field{"machine", &MachineTest::machine, "empty: not stated"},
               Field{"bar", &MachineTest::bar, "its serial number; empty: not stated"},
               Field{"date", [](const MachineTest& of) { return moment_of(of.started_s); }, "null: not stated"},
               Field{"plane", &MachineTest::plane, "XY, YZ, ZX"},
               Field{"nominal_length_mm", &MachineTest::nominal_length_mm, ""},
               Field{"feed_mm_per_min", &MachineTest::feed_mm_per_min, "null: not stated"},
               Field{"start_deg", &MachineTest::start_deg, "of the readings, counter-clockwise"},
               Field{"arc_deg", &MachineTest::arc_deg, ""},
               Field{"directions", &MachineTest::directions, "CCW, CW; empty: not stated"},
               Field{"stored", &MachineTest::stored, "values of the file, without readings"}};

template <>
inline constexpr auto kResult<MachineTest> = ResultType{
    "MachineTest", "A test of a machine.",
    std::tuple_cat(
        kMachineTestMadeWith,
        std::tuple{Field{"errors", &MachineTest::quantities, ""},
                   Field{"beyond_limits", &MachineTest::beyond_limits, "stored results that fail a limit in the file"},
                   Field{"passes", [](const MachineTest& of) { return MayLack<bool>{of.passes}; },
                         "with a tolerance: whether it and these limits hold"}})};

template <>
inline constexpr auto kResult<TestFiles> =
    ResultType{"Errors", "The errors of many ballbar tests.",
               std::tuple{Field{"tests", &TestFiles::tests, "one row per test"},
                          Field{"remarks", &TestFiles::remarks, "of the readers"},
                          Field{"skipped", &TestFiles::skipped, "files that could not be read"}}};

}  // namespace ballbar

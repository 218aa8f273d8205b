// What `errors --json` prints of many files: tests, each with its errors, and the files that have none of their own;
// with --show change two tests.
#pragma once

#include "ballbar/formats/results/message.hpp"
#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/history/errors_change.hpp"
#include "ballbar/history/history.hpp"
#include "errors/quantity_text.hpp"
#include "errors/test_comparison_text.hpp"
#include "errors/test_files.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<SkippedTest> =
    ResultType("SkippedTest", "A file that has no test of its own.", Field{"file", &SkippedTest::file},
               Field{"sentence", &SkippedTest::sentence, "with the file's name"},
               Field{"copy_of", &SkippedTest::copy_of, "file of whose test it is one; null: none"});

template <>
inline constexpr auto kResult<TestQuantity> = ResultType(
    "TestQuantity", "An error, or a quantity, of a test.", Field{"name", &TestQuantity::name},
    Field{"value", &TestQuantity::value}, Field{"sigma", &TestQuantity::sigma, "null: not known"},
    Field{"unit", &TestQuantity::unit}, Field{"significant", &TestQuantity::significant, "whether the test shows it"},
    Field{"rank", &TestQuantity::rank, "by the gain of its repair, 1 the largest; null: none"},
    Field{"of_set_up", &TestQuantity::of_set_up, "it says nothing of the machine"});

inline constexpr FieldList kMachineTestMadeWith{
    Field{"file", &MachineTest::file},
    Field{"second_file", &MachineTest::second_file, "log of the other direction; empty: none"},
    Field{"machine", &MachineTest::machine, "empty: not stated"},
    Field{"bar", &MachineTest::bar, "its serial number; empty: not stated"},
    Field{"date", in(&MachineTest::started_s, &iso_date_text), "null: not stated"},
    Field{"plane", &MachineTest::plane, "XY, YZ, ZX"},
    Field{"nominal_length_mm", &MachineTest::nominal_length_mm},
    Field{"feed_mm_per_min", &MachineTest::feed_mm_per_min, "null: not stated"},
    Field{"start_deg", &MachineTest::start_deg, "of the readings, counter-clockwise"},
    Field{"arc_deg", &MachineTest::arc_deg},
    Field{"directions", &MachineTest::directions, "CCW, CW; empty: not stated"},
    Field{"stored", &MachineTest::stored, "values of the file, without readings"}};

template <>
inline constexpr auto kResult<MachineTest> =
    ResultType("MachineTest", "A test of a machine.", kMachineTestMadeWith, Field{"errors", &MachineTest::quantities},
               Field{"beyond_limits", &MachineTest::beyond_limits, "stored results that fail a limit in the file"},
               Field{"passes", may_lack(&MachineTest::passes), "with a tolerance: whether it and these limits hold"});

template <>
inline constexpr auto kResult<TestFiles> = ResultType("Errors", "The errors of many ballbar tests.",
                                                      Field{"tests", &TestFiles::tests, "one row per test"},
                                                      Field{"remarks", &TestFiles::remarks, "of the readers"},
                                                      Field{"skipped", &TestFiles::skipped,
                                                            "files that could not be read"});

// Two tests, before and after.

template <>
inline constexpr auto kResult<QuantityDifference> = ResultType(
    "QuantityDifference", "A quantity of a test before and after.", Field{"name", &QuantityDifference::name},
    Field{"unit", &QuantityDifference::unit},
    Field{"before", &QuantityDifference::before, "null: that test has no such quantity"},
    Field{"before_sigma", &QuantityDifference::before_sigma, "null: not known"},
    Field{"after", &QuantityDifference::after}, Field{"after_sigma", &QuantityDifference::after_sigma},
    Field{"difference", &QuantityDifference::difference, "after less before"},
    Field{"sigma", &QuantityDifference::sigma, "of the difference, by the sigmas of both fits"},
    Field{"p_value", &QuantityDifference::p_value, "of noise that differs as much"},
    Field{"clear", &QuantityDifference::clear, "after the correction for all of them; null: not known"},
    Field{"shown", &QuantityDifference::shown, "whether one of the tests shows it"},
    Field{"of_set_up", &QuantityDifference::of_set_up, "it says nothing of the machine, and is never clear"});

template <>
inline constexpr auto kResult<ClearChange> = ResultType(
    "ClearChange", "An error with a significant difference.",
    Field{"name", &ClearChange::name, "backlash_a of backlash_a_pos and backlash_a_neg"},
    Field{"unit", &ClearChange::unit}, Field{"before", known(&ClearChange::before), "of the end that differs most"},
    Field{"after", known(&ClearChange::after)});

// A test without its errors.
struct TestHead {
  MachineTest test;
};

template <>
inline constexpr auto kResult<TestHead> = ResultType("TestHead", "What a test was made with.",
                                                     fields_of(&TestHead::test, kMachineTestMadeWith));

template <>
inline constexpr auto kResult<TestComparison> = ResultType(
    "TestComparison", "Two tests of a plane, before and after.",
    Field{"before", [](const TestComparison& of) { return TestHead{of.before}; }, "the first test"},
    Field{"after", [](const TestComparison& of) { return TestHead{of.after}; }, "the second"},
    Field{"differs", &TestComparison::differs,
          "nominal_length, arc, feed, directions, bar, machine, stored: what they were made with"},
    Field{"conclusion", [](const TestComparison& of) { return conclusion(of); }, "a sentence"},
    Field{"changes", [](const TestComparison& of) { return clear_changes(of); }, "what is clear, the clearest first"},
    Field{"judged", &TestComparison::judged, "quantities that are corrected for"},
    Field{"quantities", &TestComparison::quantities, "circularity, what is clear, the rest"});

}  // namespace ballbar

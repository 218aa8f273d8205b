// What `errors --show change --json` prints: two tests, before and after.
#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "ballbar/history/errors_change.hpp"
#include "errors/test_comparison_text.hpp"
#include "errors/test_result.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<QuantityDifference> = ResultType{
    "QuantityDifference", "A quantity of a test before and after.",
    std::tuple{
        Field{"name", &QuantityDifference::name, ""}, Field{"unit", &QuantityDifference::unit, ""},
        Field{"before", &QuantityDifference::before, "null: that test has no such quantity"},
        Field{"before_sigma", &QuantityDifference::before_sigma, "null: not known"},
        Field{"after", &QuantityDifference::after, ""}, Field{"after_sigma", &QuantityDifference::after_sigma, ""},
        Field{"difference", &QuantityDifference::difference, "after less before"},
        Field{"sigma", &QuantityDifference::sigma, "of the difference, by the sigmas of both fits"},
        Field{"p_value", &QuantityDifference::p_value, "of noise that differs as much"},
        Field{"clear", &QuantityDifference::clear, "after the correction for all of them; null: not known"},
        Field{"shown", &QuantityDifference::shown, "whether one of the tests shows it"},
        Field{"of_set_up", &QuantityDifference::of_set_up, "it says nothing of the machine, and is never clear"}}};

template <>
inline constexpr auto kResult<ClearChange> =
    ResultType{"ClearChange", "An error with a significant difference.",
               std::tuple{Field{"name", &ClearChange::name, "backlash_a of backlash_a_pos and backlash_a_neg"},
                          Field{"unit", &ClearChange::unit, ""},
                          Field{"before", known(&ClearChange::before), "of the end that differs most"},
                          Field{"after", known(&ClearChange::after), ""}}};

// A test without its errors.
struct TestHead {
  MachineTest test;
};

template <>
inline constexpr auto kResult<TestHead> =
    ResultType{"TestHead", "What a test was made with.", fields_through(&TestHead::test, kMachineTestMadeWith)};

struct TestHeads {
  std::vector<TestHead> tests;
};

template <>
inline constexpr auto kResult<TestHeads> =
    ResultType{"TestHeads", "The ballbar tests among files.",
               std::tuple{Field{"tests", &TestHeads::tests, "by name of the file"}}};

template <>
inline constexpr auto kResult<TestComparison> = ResultType{
    "TestComparison", "Two tests of a plane, before and after.",
    std::tuple{Field{"before", [](const TestComparison& of) { return TestHead{of.before}; }, "the first test"},
               Field{"after", [](const TestComparison& of) { return TestHead{of.after}; }, "the second"},
               Field{"differs", &TestComparison::differs,
                     "nominal_length, arc, feed, directions, bar, machine, stored: what they were made with"},
               Field{"conclusion", [](const TestComparison& of) { return conclusion(of); }, "a sentence"},
               Field{"changes", [](const TestComparison& of) { return clear_changes(of); },
                     "what is clear, the clearest first"},
               Field{"judged", &TestComparison::judged, "quantities that are corrected for"},
               Field{"quantities", &TestComparison::quantities, "circularity, what is clear, the rest"}}};

}  // namespace ballbar

// The history as a page: apps/page/src/report.ts lists the keys.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/results/message.hpp"
#include "ballbar/history/history.hpp"
#include "errors/test_results.hpp"
#include "history/found_history.hpp"
#include "page/report_head.hpp"

namespace ballbar {

// A curve with half of the interval that holds 68 %.
struct CurveOverYears {
  std::vector<double> year, values, sigmas;
};

template <>
inline constexpr auto kResult<CurveOverYears> = ResultType("CurveOverYears",
                                                           "A curve with half of the interval that holds 68 %.",
                                                           Field{"year", known(&CurveOverYears::year), "2025.5"},
                                                           Field{"values", &CurveOverYears::values},
                                                           Field{"sigmas", &CurveOverYears::sigmas});

struct DrawnQuantity {
  std::string name, unit;
  CurveOverYears tests;
  std::optional<CurveOverYears> trend;
  std::optional<std::vector<double>> marks;
  std::optional<double> lower, upper;
};

template <>
inline constexpr auto kResult<DrawnQuantity> =
    ResultType("HistoryQuantity", "A quantity over the tests with a date.", Field{"name", &DrawnQuantity::name},
               Field{"unit", &DrawnQuantity::unit}, fields_of(&DrawnQuantity::tests),
               Field{"trend", may_lack(&DrawnQuantity::trend)},
               Field{"marks", known(may_lack(&DrawnQuantity::marks)), "years in which it steps"},
               Field{"lower", known(may_lack(&DrawnQuantity::lower)), "tolerance"},
               Field{"upper", known(may_lack(&DrawnQuantity::upper))});

struct DrawnGroup {
  std::string label, first;
  Plane plane = Plane::XY;
  std::vector<DrawnQuantity> quantities;
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> rows;
};

template <>
inline constexpr auto kResult<DrawnGroup> =
    ResultType("HistoryGroup", "Tests that can be compared.",
               Field{"label", &DrawnGroup::label, "XY, 100 mm, 1000 mm/min, 360 deg"},
               Field{"first", &DrawnGroup::first, "quantity to look at first"},
               Field{"plane", &DrawnGroup::plane, "XY, YZ, ZX"}, Field{"quantities", &DrawnGroup::quantities},
               Field{"heading", &DrawnGroup::heading, "of the table"}, Field{"rows", &DrawnGroup::rows});

// A test as a row of the list.
struct DrawnTest {
  MachineTest test;
  std::optional<double> circularity_um, circularity_sigma_um;
  std::string first_to_mend;
};

template <>
inline constexpr auto kResult<DrawnTest> =
    ResultType("DrawnTest", "A test in the list of a machine's.", fields_of(&DrawnTest::test, kMachineTestMadeWith),
               Field{"circularity_um", &DrawnTest::circularity_um, "null: not stored"},
               Field{"circularity_sigma_um", &DrawnTest::circularity_sigma_um, "null: not known"},
               Field{"first_to_mend", &DrawnTest::first_to_mend, "empty: none"});

struct HistoryPart {
  std::vector<DrawnGroup> groups;
  std::vector<Paragraph> geometry;
  std::vector<std::vector<std::string>> geometry_rows;
  std::vector<std::string> skipped;
  std::vector<DrawnTest> tests;
};

template <>
inline constexpr auto kResult<HistoryPart> =
    ResultType("HistoryPart", "A machine over its tests, as it is drawn.", Field{"groups", &HistoryPart::groups},
               Field{"geometry", &HistoryPart::geometry, "sentences"},
               Field{"geometry_rows", &HistoryPart::geometry_rows, "what, um/m, from"},
               Field{"skipped", &HistoryPart::skipped, "sentences"}, Field{"tests", &HistoryPart::tests, "by date"});

struct DrawnMachine {
  std::string label;
  Paragraph reason;
  std::vector<Paragraph> findings;
  std::string first;
  std::vector<DrawnQuantity> quantities;
};

template <>
inline constexpr auto kResult<DrawnMachine> = ResultType(
    "DrawnMachine", "A machine that needs something, as it is drawn.", Field{"label", &DrawnMachine::label, "its name"},
    Field{"reason", &DrawnMachine::reason, "why it is called"},
    Field{"findings", &DrawnMachine::findings, "what was found and what to do"},
    Field{"first", &DrawnMachine::first, "quantity to look at first"},
    Field{"quantities", &DrawnMachine::quantities, "with the curve that was found"});

struct FleetPart {
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> rows;
  std::vector<DrawnMachine> machines;
};

template <>
inline constexpr auto kResult<FleetPart> = ResultType("FleetPart", "Many machines over their tests, as they are drawn.",
                                                      Field{"heading", &FleetPart::heading, "of the ranking"},
                                                      Field{"rows", &FleetPart::rows},
                                                      Field{"machines", &FleetPart::machines, "that need something"});

// A page of one machine with all its quantities, or of several ranked.
struct HistoryReport {
  ReportHead head;
  std::optional<HistoryPart> history;
  std::optional<FleetPart> fleet;
};
// `title`: of the folder.
HistoryReport history_report(const std::string& title, const FoundHistory& found);

template <>
inline constexpr auto kResult<HistoryReport> =
    ResultType("HistoryReport", "The data of a page of machines over their tests.", fields_of(&HistoryReport::head),
               Field{"history", may_lack(&HistoryReport::history), "of one machine"},
               Field{"fleet", may_lack(&HistoryReport::fleet), "of several"});

// Bytes of the .html. `title`: of the folder. One machine with all its quantities; several ranked.
std::string history_page(const std::string& title, const FoundHistory& found);

// The ranking alone; `remarks`: sentences on what was not read, below the conclusion.
std::string ranking_page(const std::string& title, const std::vector<std::filesystem::path>& files,
                         const History& history, const std::vector<std::string>& remarks = {});

}  // namespace ballbar

// The history as a page: apps/page/src/report.ts lists the keys.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ballbar/formats/results/message.hpp"
#include "ballbar/history/history.hpp"
#include "errors/test_result.hpp"
#include "history/found_history.hpp"
#include "page/report_head.hpp"

namespace ballbar {

// A curve with half of the interval that holds 68 %.
struct CurveOverYears {
  std::vector<double> year, values, sigmas;
};

template <>
inline constexpr auto kResult<CurveOverYears> =
    ResultType{"CurveOverYears", "A curve with half of the interval that holds 68 %.",
               std::tuple{Field{"year", known(&CurveOverYears::year), "2025.5"},
                          Field{"values", &CurveOverYears::values, ""}, Field{"sigmas", &CurveOverYears::sigmas, ""}}};

struct DrawnQuantity {
  std::string name, unit;
  CurveOverYears tests;
  MayLack<CurveOverYears> trend;
  MayLack<std::vector<double>> marks;
  MayLack<double> lower, upper;
};

template <>
inline constexpr auto kResult<DrawnQuantity> = ResultType{
    "HistoryQuantity", "A quantity over the tests with a date.",
    std::tuple_cat(std::tuple{Field{"name", &DrawnQuantity::name, ""}, Field{"unit", &DrawnQuantity::unit, ""}},
                   fields_through(&DrawnQuantity::tests, kResult<CurveOverYears>.fields),
                   std::tuple{Field{"trend", &DrawnQuantity::trend, ""},
                              Field{"marks", known(&DrawnQuantity::marks), "years in which it steps"},
                              Field{"lower", known(&DrawnQuantity::lower), "tolerance"},
                              Field{"upper", known(&DrawnQuantity::upper), ""}})};

struct DrawnGroup {
  std::string label, first;
  Plane plane = Plane::XY;
  std::vector<DrawnQuantity> quantities;
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> rows;
};

template <>
inline constexpr auto kResult<DrawnGroup> = ResultType{
    "HistoryGroup", "Tests that can be compared.",
    std::tuple{Field{"label", &DrawnGroup::label, "XY, 100 mm, 1000 mm/min, 360 deg"},
               Field{"first", &DrawnGroup::first, "quantity to look at first"},
               Field{"plane", &DrawnGroup::plane, "XY, YZ, ZX"}, Field{"quantities", &DrawnGroup::quantities, ""},
               Field{"heading", &DrawnGroup::heading, "of the table"}, Field{"rows", &DrawnGroup::rows, ""}}};

// A test as a row of the list.
struct DrawnTest {
  MachineTest test;
  std::optional<double> circularity_um, circularity_sigma_um;
  std::string first_to_mend;
};

template <>
inline constexpr auto kResult<DrawnTest> = ResultType{
    "DrawnTest", "A test in the list of a machine's.",
    std::tuple_cat(fields_through(&DrawnTest::test, kMachineTestMadeWith),
                   std::tuple{Field{"circularity_um", &DrawnTest::circularity_um, "null: not stored"},
                              Field{"circularity_sigma_um", &DrawnTest::circularity_sigma_um, "null: not known"},
                              Field{"first_to_mend", &DrawnTest::first_to_mend, "empty: none"}})};

struct HistoryPart {
  std::vector<DrawnGroup> groups;
  std::vector<Paragraph> geometry;
  std::vector<std::vector<std::string>> geometry_rows;
  std::vector<std::string> skipped;
  std::vector<DrawnTest> tests;
};

template <>
inline constexpr auto kResult<HistoryPart> = ResultType{
    "HistoryPart", "A machine over its tests, as it is drawn.",
    std::tuple{Field{"groups", &HistoryPart::groups, ""}, Field{"geometry", &HistoryPart::geometry, "sentences"},
               Field{"geometry_rows", &HistoryPart::geometry_rows, "what, um/m, from"},
               Field{"skipped", &HistoryPart::skipped, "sentences"}, Field{"tests", &HistoryPart::tests, "by date"}}};

struct DrawnMachine {
  std::string label;
  Paragraph reason;
  std::vector<Paragraph> findings;
  std::string first;
  std::vector<DrawnQuantity> quantities;
};

template <>
inline constexpr auto kResult<DrawnMachine> =
    ResultType{"DrawnMachine", "A machine that needs something, as it is drawn.",
               std::tuple{Field{"label", &DrawnMachine::label, "its name"},
                          Field{"reason", &DrawnMachine::reason, "why it is called"},
                          Field{"findings", &DrawnMachine::findings, "what was found and what to do"},
                          Field{"first", &DrawnMachine::first, "quantity to look at first"},
                          Field{"quantities", &DrawnMachine::quantities, "with the curve that was found"}}};

struct FleetPart {
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> rows;
  std::vector<DrawnMachine> machines;
};

template <>
inline constexpr auto kResult<FleetPart> =
    ResultType{"FleetPart", "Many machines over their tests, as they are drawn.",
               std::tuple{Field{"heading", &FleetPart::heading, "of the ranking"}, Field{"rows", &FleetPart::rows, ""},
                          Field{"machines", &FleetPart::machines, "that need something"}}};

// A page with one of both.
struct HistoryReport {
  ReportHead head;
  HistoryPart history;
};
struct FleetReport {
  ReportHead head;
  FleetPart fleet;
};

template <>
inline constexpr auto kResult<HistoryReport> =
    ResultType{"HistoryReport", "The data of a page of a machine over its tests.",
               std::tuple_cat(fields_through(&HistoryReport::head, kResult<ReportHead>.fields),
                              std::tuple{Field{"history", &HistoryReport::history, ""}})};

template <>
inline constexpr auto kResult<FleetReport> =
    ResultType{"FleetReport", "The data of a page of many machines.",
               std::tuple_cat(fields_through(&FleetReport::head, kResult<ReportHead>.fields),
                              std::tuple{Field{"fleet", &FleetReport::fleet, ""}})};

// `title`: of the folder. One machine with all its quantities; several ranked.
std::variant<HistoryReport, FleetReport> history_report(const std::string& title, const FoundHistory& found);

// Bytes of the .html. `title`: of the folder. One machine with all its quantities; several ranked.
std::string history_page(const std::string& title, const FoundHistory& found);

// The ranking alone; `remarks`: sentences on what was not read, below the conclusion.
std::string ranking_page(const std::string& title, const std::vector<std::filesystem::path>& files,
                         const History& history, const std::vector<std::string>& remarks = {});

}  // namespace ballbar

// What `history --json` prints: History with squareness, scales and skipped files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/results/message.hpp"
#include "ballbar/history/history.hpp"
#include "errors/quantity_text.hpp"
#include "errors/test_files.hpp"
#include "errors/test_result.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<Trend> = ResultType{
    "Trend", "A straight line over time.",
    std::tuple{Field{"rate_per_year", &Trend::rate_per_year, ""}, Field{"sigma_per_year", &Trend::sigma_per_year, ""},
               Field{"p_value", &Trend::p_value, "of a rate as far from 0 by chance"},
               Field{"scatter", &Trend::scatter, "from test to test beyond the sigmas"},
               Field{"tests", &Trend::tests, "how many"}}};

template <>
inline constexpr auto kResult<TestGroup> = ResultType{
    "TestGroup", "Tests that can be compared.",
    std::tuple{Field{"plane", &TestGroup::plane, "XY, YZ, ZX"}, Field{"length_mm", &TestGroup::nominal_length_mm, ""},
               Field{"feed_mm_per_min", &TestGroup::feed_mm_per_min, "null: not stated"},
               Field{"start_deg", &TestGroup::start_deg, ""}, Field{"arc_deg", &TestGroup::arc_deg, ""},
               Field{"tests", [](const TestGroup& of) { return of.tests.size(); }, "how many"}}};

inline std::optional<std::string> day_of(const std::optional<double>& time_s) {
  return time_s ? std::optional(date_text(*time_s)) : std::nullopt;
}

template <class Type>
inline constexpr std::tuple kQuantityFields{Field{"quantity", &Type::name, ""},
                                            Field{"plane", &Type::plane, "XY, YZ, ZX"}, Field{"unit", &Type::unit, ""}};
template <class Type>
inline constexpr std::tuple kLevelFields{Field{"level", &Type::level, "of the curve at the last test"},
                                         Field{"sigma", &Type::level_sigma, "of the level"}};

template <>
inline constexpr auto kResult<FindingQuantity> = ResultType{
    "FindingQuantity", "A quantity that has part in a finding.",
    std::tuple_cat(
        kQuantityFields<FindingQuantity>,
        std::tuple{Field{"size", &FindingQuantity::size, "after minus before, per year, or half from trough to peak"},
                   Field{"sigma", &FindingQuantity::sigma, "of the size"},
                   Field{"p_value", &FindingQuantity::p_value, ""},
                   Field{"q_value", &FindingQuantity::q_value, "corrected for all questions"}})};

template <>
inline constexpr auto kResult<Finding> = ResultType{
    "Finding", "What was found of a machine.",
    std::tuple{
        Field{"kind", &Finding::kind, "step, replaced_part, instrument, trend, season"},
        Field{"from", [](const Finding& of) { return date_text(of.from_s); },
              "date; the tests between which it steps, else the first and the last"},
        Field{"to", [](const Finding& of) { return date_text(of.to_s); }, ""},
        Field{"axis",
              [](const Finding& of) { return of.axis ? std::optional(std::string(1, "XYZ"[*of.axis])) : std::nullopt; },
              "where it is one"},
        Field{"p_value", &Finding::p_value, "of the most significant quantity"},
        Field{"q_value", &Finding::q_value, ""}, Field{"sentence", &Finding::sentence, "what was found"},
        Field{"remedy", &Finding::remedy, "what to do"},
        Field{"quantities", &Finding::quantities, "the clearest first"}}};

inline std::string_view name_of(Outlook outlook) {
  constexpr std::string_view kNames[] = {"beyond", "no_trend", "not_within_10_years", "expected"};
  return kNames[static_cast<std::size_t>(outlook)];
}

template <>
inline constexpr auto kResult<ToleranceOutlook> = ResultType{
    "ToleranceOutlook", "A tolerance, and when it is met.",
    std::tuple_cat(
        kQuantityFields<ToleranceOutlook>, kLevelFields<ToleranceOutlook>,
        std::tuple{
            Field{"lower", [](const ToleranceOutlook& of) { return of.tolerance.lower; }, "null: none"},
            Field{"upper", [](const ToleranceOutlook& of) { return of.tolerance.upper; }, ""},
            Field{"outlook", [](const ToleranceOutlook& of) { return of.date.outlook; },
                  "beyond, expected, no_trend, not_within_10_years"},
            Field{"met", [](const ToleranceOutlook& of) { return day_of(of.date.at_s); }, "date; null: not known"},
            Field{"earliest", [](const ToleranceOutlook& of) { return day_of(of.date.earliest_s); }, ""},
            Field{"latest", [](const ToleranceOutlook& of) { return day_of(of.date.latest_s); }, ""},
            Field{"last_test_alone", &ToleranceOutlook::last_alone, "only the last test is beyond, not the level"}})};

template <>
inline constexpr auto kResult<QuantityHistory> = ResultType{
    "QuantityHistory", "A quantity of a machine over its tests.",
    std::tuple_cat(kQuantityFields<QuantityHistory>, kLevelFields<QuantityHistory>,
                   std::tuple{Field{"group", &QuantityHistory::group, "place in groups"},
                              Field{"scatter", &QuantityHistory::scatter, "about the curve"},
                              Field{"dates",
                                    [](const QuantityHistory& of) {
                                      std::vector<std::string> dates;
                                      for (const double time_s : of.time_s) dates.push_back(date_text(time_s));
                                      return dates;
                                    },
                                    ""},
                              Field{"values", &QuantityHistory::value, "of tests of a day the mean"},
                              Field{"sigmas", &QuantityHistory::sigma, "of the fits; null: not known"},
                              Field{"last", &QuantityHistory::last, "of the last test"},
                              Field{"last_sigma", &QuantityHistory::last_sigma, "null: not known"},
                              Field{"fitted", &QuantityHistory::fitted, ""},
                              Field{"significant", &QuantityHistory::significant, "the last value"},
                              Field{"trend", [](const QuantityHistory& of) { return MayLack<Trend>{of.trend}; },
                                    "through the values since the last step"}})};

template <>
inline constexpr auto kResult<MachineHistory> = ResultType{
    "MachineHistory", "A machine, and what it needs.",
    std::tuple{Field{"machine", &MachineHistory::name, "as its tests state it, else the folder that was given"},
               Field{"tests", &MachineHistory::tests, "how many"},
               Field{"first", [](const MachineHistory& of) { return day_of(of.first_s); }, "date"},
               Field{"last", [](const MachineHistory& of) { return day_of(of.last_s); }, ""},
               Field{"need", &MachineHistory::need, "beyond, expected, finding, nothing"},
               Field{"reason", &MachineHistory::reason, "reason of its rank"},
               Field{"findings", &MachineHistory::findings, "the clearest first"},
               Field{"tolerances", &MachineHistory::tolerances, ""},
               Field{"series", &MachineHistory::series,
                     "every one of one machine and of stored values alone, else those with findings and tolerances"},
               Field{"groups", &MachineHistory::groups, "of tests that can be compared"}}};

template <>
inline constexpr auto kResult<BarChange> =
    ResultType{"BarChange", "A change of the bar that machines are tested with.",
               std::tuple{Field{"from", &BarChange::from, "serial number"}, Field{"to", &BarChange::to, ""},
                          Field{"machines", &BarChange::machines, ""},
                          Field{"step_um_per_m", &BarChange::size_ppm, "mean step of the scales"},
                          Field{"sigma_um_per_m", &BarChange::sigma_ppm, ""}}};

template <>
inline constexpr auto kResult<History> = ResultType{
    "Ranking", "Machines over their tests, what needs something first.",
    std::tuple{Field{"machines", &History::machines, "what needs something first"},
               Field{"bar_changes", &History::bar_changes, ""}, Field{"judged", &History::judged, "questions"},
               Field{"found", &History::found, "number of these that are significant"},
               Field{"false_discovery_rate", &History::false_discovery_rate, "share of those by chance"},
               Field{"without_date", &History::without_date, "files of tests that are in nothing"}}};

constexpr auto letter_of(auto member) {
  return [member](const auto& of) { return std::string(1, "XYZ"[of.*member]); };
}

template <>
inline constexpr auto kResult<PlaneSquareness> =
    ResultType{"PlaneSquareness", "How far a plane is out of square.",
               std::tuple{Field{"plane", &PlaneSquareness::plane, ""}, Field{"value", &PlaneSquareness::value, "um/m"},
                          Field{"sigma", &PlaneSquareness::sigma, ""},
                          Field{"p_value", &PlaneSquareness::p_value, "of tests that differ as much by chance"},
                          Field{"files", &PlaneSquareness::files, "that it is from"}}};

template <>
inline constexpr auto kResult<AxisScale> =
    ResultType{"AxisScale", "The scale of an axis.",
               std::tuple{Field{"axis", letter_of(&AxisScale::axis), "X, Y, Z"},
                          Field{"value", &AxisScale::value_ppm, "um/m"}, Field{"sigma", &AxisScale::sigma_ppm, ""},
                          Field{"planes", &AxisScale::planes, "that it is measured in"}}};

template <>
inline constexpr auto kResult<ScalePull> = ResultType{
    "ScalePull", "The scale of an axis in one test.",
    std::tuple{Field{"file", &ScalePull::file, ""}, Field{"plane", &ScalePull::plane, ""},
               Field{"axis", letter_of(&ScalePull::axis), "X, Y, Z"}, Field{"value", &ScalePull::value_ppm, "um/m"},
               Field{"sigma", &ScalePull::sigma_ppm, ""},
               Field{"pull", &ScalePull::pull, "residual over its sigma; null: only this test shows the axis"}}};

template <>
inline constexpr auto kResult<ScaleAgreement> =
    ResultType{"AgreementOfTests", "Whether tests of several planes agree.",
               std::tuple{Field{"chi2", &ScaleAgreement::chi2, ""},
                          Field{"degrees", &ScaleAgreement::degrees, "of freedom; 0: nothing to compare"},
                          Field{"p_value", &ScaleAgreement::p_value, ""},
                          Field{"scatter_um_per_m", &ScaleAgreement::scatter_ppm,
                                "of each scale beyond its sigma, where they disagree"},
                          Field{"pulls", &ScaleAgreement::pulls, "one row per scale and test"}}};

template <>
inline constexpr auto kResult<MachineGeometry> =
    ResultType{"MachineGeometry", "Squareness and scales of a machine.",
               std::tuple{Field{"within_a_day", &MachineGeometry::within_a_day, "whether all tests are"},
                          Field{"out_of_square_um_per_m", &MachineGeometry::squareness, "one row per plane"},
                          Field{"scales_um_per_m", &MachineGeometry::scales, "one row per axis"},
                          Field{"agreement", &MachineGeometry::agreement, "of the tests"}}};

struct HistoryResult {
  History history;
  MayLack<MachineGeometry> geometry;
  std::vector<std::string> remarks;
  std::vector<SkippedTest> skipped;
};

template <>
inline constexpr auto kResult<HistoryResult> = ResultType{
    "History", "Machines over their tests.",
    std::tuple_cat(fields_through(&HistoryResult::history, kResult<History>.fields),
                   std::tuple{Field{"geometry", &HistoryResult::geometry, "squareness and scales, of one machine"},
                              Field{"remarks", &HistoryResult::remarks, "of the readers"},
                              Field{"skipped", &HistoryResult::skipped, "files that could not be read"}})};

}  // namespace ballbar

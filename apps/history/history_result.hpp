// What `history --json` prints.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/results/message.hpp"
#include "ballbar/history/history.hpp"
#include "errors/quantity_text.hpp"
#include "errors/test_results.hpp"
#include "history/found_history.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<Trend> =
    ResultType("Trend", "A straight line over time.", Field{"rate_per_year", &Trend::rate_per_year},
               Field{"sigma_per_year", &Trend::sigma_per_year},
               Field{"p_value", &Trend::p_value, "of a rate as far from 0 by chance"},
               Field{"scatter", &Trend::scatter, "from test to test beyond the sigmas"},
               Field{"tests", &Trend::tests, "how many"});

template <>
inline constexpr auto kResult<TestGroup> =
    ResultType("TestGroup", "Tests that can be compared.", Field{"plane", &TestGroup::plane, "XY, YZ, ZX"},
               Field{"length_mm", &TestGroup::nominal_length_mm},
               Field{"feed_mm_per_min", &TestGroup::feed_mm_per_min, "null: not stated"},
               Field{"start_deg", &TestGroup::start_deg}, Field{"arc_deg", &TestGroup::arc_deg},
               Field{"tests", count(&TestGroup::tests), "how many"});

inline std::string letter_of(std::size_t axis) { return std::string(1, "XYZ"[axis]); }
inline std::vector<std::string> day_texts(const std::vector<double>& time_s) {
  std::vector<std::string> dates;
  dates.reserve(time_s.size());
  for (const double one_s : time_s) dates.push_back(date_text(one_s));
  return dates;
}

template <class Type>
inline constexpr FieldList kQuantityFields{Field{"quantity", &Type::name}, Field{"plane", &Type::plane, "XY, YZ, ZX"},
                                           Field{"unit", &Type::unit}};
template <class Type>
inline constexpr FieldList kLevelFields{Field{"level", &Type::level, "of the curve at the last test"},
                                        Field{"sigma", &Type::level_sigma, "of the level"}};

template <>
inline constexpr auto kResult<FindingQuantity> =
    ResultType("FindingQuantity", "A quantity that has part in a finding.", kQuantityFields<FindingQuantity>,
               Field{"size", &FindingQuantity::size, "after minus before, per year, or half from trough to peak"},
               Field{"sigma", &FindingQuantity::sigma, "of the size"}, Field{"p_value", &FindingQuantity::p_value},
               Field{"q_value", &FindingQuantity::q_value, "corrected for all questions"});

template <>
inline constexpr auto kResult<Finding> = ResultType(
    "Finding", "What was found of a machine.",
    Field{"kind", &Finding::kind, "step, replaced_part, instrument, trend, season"},
    Field{"from", in(&Finding::from_s, &date_text),
          "date; the tests between which it steps, else the first and the last"},
    Field{"to", in(&Finding::to_s, &date_text)}, Field{"axis", in(&Finding::axis, &letter_of), "where it is one"},
    Field{"p_value", &Finding::p_value, "of the most significant quantity"}, Field{"q_value", &Finding::q_value},
    Field{"sentence", &Finding::sentence, "what was found"}, Field{"remedy", &Finding::remedy, "what to do"},
    Field{"quantities", &Finding::quantities, "the clearest first"});

inline std::string_view name_of(Outlook outlook) {
  constexpr std::string_view kNames[] = {"beyond", "no_trend", "not_within_10_years", "expected"};
  return kNames[static_cast<std::size_t>(outlook)];
}

template <>
inline constexpr auto kResult<ToleranceOutlook> = ResultType(
    "ToleranceOutlook", "A tolerance, and when it is met.", kQuantityFields<ToleranceOutlook>,
    kLevelFields<ToleranceOutlook>, Field{"lower", in(&ToleranceOutlook::tolerance, &Tolerance::lower), "null: none"},
    Field{"upper", in(&ToleranceOutlook::tolerance, &Tolerance::upper)},
    Field{"outlook", in(&ToleranceOutlook::date, &ToleranceDate::outlook),
          "beyond, expected, no_trend, not_within_10_years"},
    Field{"met", in(&ToleranceOutlook::date, &ToleranceDate::at_s, &date_text), "date; null: not known"},
    Field{"earliest", in(&ToleranceOutlook::date, &ToleranceDate::earliest_s, &date_text)},
    Field{"latest", in(&ToleranceOutlook::date, &ToleranceDate::latest_s, &date_text)},
    Field{"last_test_alone", &ToleranceOutlook::last_alone, "only the last test is beyond, not the level"});

template <>
inline constexpr auto kResult<QuantityHistory> = ResultType(
    "QuantityHistory", "A quantity of a machine over its tests.", kQuantityFields<QuantityHistory>,
    kLevelFields<QuantityHistory>, Field{"group", &QuantityHistory::group, "place in groups"},
    Field{"scatter", &QuantityHistory::scatter, "about the curve"},
    Field{"dates", in(&QuantityHistory::time_s, &day_texts)},
    Field{"values", &QuantityHistory::value, "of tests of a day the mean"},
    Field{"sigmas", &QuantityHistory::sigma, "of the fits; null: not known"},
    Field{"last", &QuantityHistory::last, "of the last test"},
    Field{"last_sigma", &QuantityHistory::last_sigma, "null: not known"}, Field{"fitted", &QuantityHistory::fitted},
    Field{"significant", &QuantityHistory::significant, "the last value"},
    Field{"trend", may_lack(&QuantityHistory::trend), "through the values since the last step"});

template <>
inline constexpr auto kResult<MachineHistory> =
    ResultType("MachineHistory", "A machine, and what it needs.",
               Field{"machine", &MachineHistory::name, "as its tests state it, else the folder that was given"},
               Field{"tests", &MachineHistory::tests, "how many"},
               Field{"first", in(&MachineHistory::first_s, &date_text), "date"},
               Field{"last", in(&MachineHistory::last_s, &date_text)},
               Field{"need", &MachineHistory::need, "beyond, expected, finding, nothing"},
               Field{"reason", &MachineHistory::reason, "reason of its rank"},
               Field{"findings", &MachineHistory::findings, "the clearest first"},
               Field{"tolerances", &MachineHistory::tolerances},
               Field{"series", &MachineHistory::series,
                     "every one of one machine and of stored values alone, else those with findings and tolerances"},
               Field{"groups", &MachineHistory::groups, "of tests that can be compared"});

template <>
inline constexpr auto kResult<BarChange> = ResultType(
    "BarChange", "A change of the bar that machines are tested with.", Field{"from", &BarChange::from, "serial number"},
    Field{"to", &BarChange::to}, Field{"machines", &BarChange::machines},
    Field{"step_um_per_m", &BarChange::size_ppm, "mean step of the scales"},
    Field{"sigma_um_per_m", &BarChange::sigma_ppm});

template <>
inline constexpr auto kResult<History> =
    ResultType("Ranking", "Machines over their tests, what needs something first.",
               Field{"machines", &History::machines, "what needs something first"},
               Field{"bar_changes", &History::bar_changes}, Field{"judged", &History::judged, "questions"},
               Field{"found", &History::found, "number of these that are significant"},
               Field{"false_discovery_rate", &History::false_discovery_rate, "share of those by chance"},
               Field{"without_date", &History::without_date, "files of tests that are in nothing"});

template <>
inline constexpr auto kResult<PlaneSquareness> =
    ResultType("PlaneSquareness", "How far a plane is out of square.", Field{"plane", &PlaneSquareness::plane},
               Field{"value", &PlaneSquareness::value, "um/m"}, Field{"sigma", &PlaneSquareness::sigma},
               Field{"p_value", &PlaneSquareness::p_value, "of tests that differ as much by chance"},
               Field{"files", &PlaneSquareness::files, "that it is from"});

template <>
inline constexpr auto kResult<AxisScale> = ResultType("AxisScale", "The scale of an axis.",
                                                      Field{"axis", in(&AxisScale::axis, &letter_of), "X, Y, Z"},
                                                      Field{"value", &AxisScale::value_ppm, "um/m"},
                                                      Field{"sigma", &AxisScale::sigma_ppm},
                                                      Field{"planes", &AxisScale::planes, "that it is measured in"});

template <>
inline constexpr auto kResult<ScalePull> =
    ResultType("ScalePull", "The scale of an axis in one test.", Field{"file", &ScalePull::file},
               Field{"plane", &ScalePull::plane}, Field{"axis", in(&ScalePull::axis, &letter_of), "X, Y, Z"},
               Field{"value", &ScalePull::value_ppm, "um/m"}, Field{"sigma", &ScalePull::sigma_ppm},
               Field{"pull", &ScalePull::pull, "residual over its sigma; null: only this test shows the axis"});

template <>
inline constexpr auto kResult<ScaleAgreement> = ResultType(
    "AgreementOfTests", "Whether tests of several planes agree.", Field{"chi2", &ScaleAgreement::chi2},
    Field{"degrees", &ScaleAgreement::degrees, "of freedom; 0: nothing to compare"},
    Field{"p_value", &ScaleAgreement::p_value},
    Field{"scatter_um_per_m", &ScaleAgreement::scatter_ppm, "of each scale beyond its sigma, where they disagree"},
    Field{"pulls", &ScaleAgreement::pulls, "one row per scale and test"});

template <>
inline constexpr auto kResult<MachineGeometry> =
    ResultType("MachineGeometry", "Squareness and scales of a machine.",
               Field{"within_a_day", &MachineGeometry::within_a_day, "whether all tests are"},
               Field{"out_of_square_um_per_m", &MachineGeometry::squareness, "one row per plane"},
               Field{"scales_um_per_m", &MachineGeometry::scales, "one row per axis"},
               Field{"agreement", &MachineGeometry::agreement, "of the tests"});

template <>
inline constexpr auto kResult<FoundHistory> =
    ResultType("History", "Machines over their tests.", fields_of(&FoundHistory::history),
               Field{"geometry", may_lack(&FoundHistory::geometry), "squareness and scales, of one machine"},
               fields_of(&FoundHistory::files, Field{"remarks", &TestFiles::remarks, "of the readers"},
                         Field{"skipped", &TestFiles::skipped, "files that could not be read"}));

}  // namespace ballbar

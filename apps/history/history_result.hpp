// What `history --json` prints: History, whose parts name each other by their places, with geometry and skipped files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/history/history.hpp"
#include "history/geometry_result.hpp"
#include "history/quantity_text.hpp"
#include "history/test_files.hpp"
#include "history/test_result.hpp"

namespace ballbar {

template <>
struct ResultType<Trend> {
  static constexpr std::string_view name = "Trend";
  static constexpr std::string_view meaning = "A straight line over time.";
  static constexpr std::tuple fields{Field{"rate_per_year", &Trend::rate_per_year, ""},
                                     Field{"sigma_per_year", &Trend::sigma_per_year, ""},
                                     Field{"p_value", &Trend::p_value, "of a rate as far from 0 by chance"},
                                     Field{"scatter", &Trend::scatter, "from test to test beyond the sigmas"},
                                     Field{"tests", &Trend::tests, "how many"}};
};

template <>
struct ResultType<TestGroup> {
  static constexpr std::string_view name = "TestGroup";
  static constexpr std::string_view meaning = "Tests that can be compared.";
  static constexpr std::tuple fields{Field{"plane", &TestGroup::plane, "XY, YZ, ZX"},
                                     Field{"length_mm", &TestGroup::nominal_length_mm, ""},
                                     Field{"feed_mm_per_min", &TestGroup::feed_mm_per_min, "null: not stated"},
                                     Field{"start_deg", &TestGroup::start_deg, ""},
                                     Field{"arc_deg", &TestGroup::arc_deg, ""},
                                     Field{"tests", [](const TestGroup& of) { return of.tests.size(); }, "how many"}};
};

inline std::optional<std::string> day_of(const std::optional<double>& time_s) {
  return time_s ? std::optional(date_text(*time_s)) : std::nullopt;
}

// What a finding or a tolerance states of a quantity.
template <class Part>
struct OfSeries {
  QuantityHistory series;
  Part part;
};

inline constexpr std::tuple kQuantityFields{Field{"quantity", &QuantityHistory::name, ""},
                                            Field{"plane", &QuantityHistory::plane, "XY, YZ, ZX"},
                                            Field{"unit", &QuantityHistory::unit, ""}};
inline constexpr std::tuple kLevelFields{Field{"level", &QuantityHistory::level, "of the curve at the last test"},
                                         Field{"sigma", &QuantityHistory::level_sigma, "of the level"}};

template <>
struct ResultType<OfSeries<FindingQuantity>> {
  static constexpr std::string_view name = "FindingQuantity";
  static constexpr std::string_view meaning = "A quantity that has part in a finding.";
  static constexpr std::tuple found{
      Field{"size", &FindingQuantity::size, "after less before, a year, or half from trough to peak"},
      Field{"sigma", &FindingQuantity::sigma, "of the size"}, Field{"p_value", &FindingQuantity::p_value, ""},
      Field{"q_value", &FindingQuantity::q_value, "corrected for all questions"}};
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&OfSeries<FindingQuantity>::series, kQuantityFields),
                     fields_through(&OfSeries<FindingQuantity>::part, found));
};

struct FindingResult {
  Finding finding;
  std::vector<OfSeries<FindingQuantity>> quantities;
};

template <>
struct ResultType<FindingResult> {
  static constexpr std::string_view name = "Finding";
  static constexpr std::string_view meaning = "What was found of a machine.";
  static constexpr std::tuple found{
      Field{"kind", &Finding::kind, "step, replaced_part, instrument, trend, season"},
      Field{"from", [](const Finding& of) { return date_text(of.from_s); },
            "date; the tests between which it steps, else the first and the last"},
      Field{"to", [](const Finding& of) { return date_text(of.to_s); }, ""},
      Field{"axis",
            [](const Finding& of) { return of.axis ? std::optional(std::string(1, "XYZ"[*of.axis])) : std::nullopt; },
            "where it is one"},
      Field{"p_value", &Finding::p_value, "of the clearest quantity"},
      Field{"q_value", &Finding::q_value, ""},
      Field{"sentence", &Finding::sentence, "what was found"},
      Field{"remedy", &Finding::remedy, "what to do"}};
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&FindingResult::finding, found),
                     std::tuple{Field{"quantities", &FindingResult::quantities, "the clearest first"}});
};

template <>
struct ResultType<OfSeries<ToleranceOutlook>> {
  static constexpr std::string_view name = "ToleranceOutlook";
  static constexpr std::string_view meaning = "A tolerance, and when it is met.";
  static constexpr std::tuple met{
      Field{"lower", [](const ToleranceOutlook& of) { return of.tolerance.lower; }, "null: none"},
      Field{"upper", [](const ToleranceOutlook& of) { return of.tolerance.upper; }, ""},
      Field{"outlook", [](const ToleranceOutlook& of) { return of.date.outlook; },
            "beyond, expected, no_trend, not_within_10_years"},
      Field{"met", [](const ToleranceOutlook& of) { return day_of(of.date.at_s); }, "date; null: not known"},
      Field{"earliest", [](const ToleranceOutlook& of) { return day_of(of.date.earliest_s); }, ""},
      Field{"latest", [](const ToleranceOutlook& of) { return day_of(of.date.latest_s); }, ""},
      Field{"last_test_alone", &ToleranceOutlook::last_alone, "the last test is beyond, the level is not"}};
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&OfSeries<ToleranceOutlook>::series, std::tuple_cat(kQuantityFields, kLevelFields)),
                     fields_through(&OfSeries<ToleranceOutlook>::part, met));
};

template <>
struct ResultType<QuantityHistory> {
  static constexpr std::string_view name = "QuantityHistory";
  static constexpr std::string_view meaning = "A quantity of a machine over its tests.";
  static constexpr std::tuple fields =
      std::tuple_cat(kQuantityFields, kLevelFields,
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
                                Field{"fitted", &QuantityHistory::fitted, ""},
                                Field{"significant", &QuantityHistory::significant, "the last value"},
                                Field{"trend", [](const QuantityHistory& of) { return MayLack<Trend>{of.trend}; },
                                      "through the values since the last step"}});
};

std::vector<FindingResult> findings_of(const MachineHistory& machine);
std::vector<OfSeries<ToleranceOutlook>> tolerances_of(const MachineHistory& machine);

template <>
struct ResultType<MachineHistory> {
  static constexpr std::string_view name = "MachineHistory";
  static constexpr std::string_view meaning = "A machine, and what it needs.";
  static constexpr std::tuple fields{
      Field{"machine", &MachineHistory::name, "as its tests state it, else the folder that was given"},
      Field{"tests", &MachineHistory::tests, "how many"},
      Field{"first", [](const MachineHistory& of) { return day_of(of.first_s); }, "date"},
      Field{"last", [](const MachineHistory& of) { return day_of(of.last_s); }, ""},
      Field{"need", &MachineHistory::need, "beyond, expected, finding, nothing"},
      Field{"reason", &MachineHistory::reason, "why it stands where it does"},
      Field{"findings", &findings_of, "the clearest first"},
      Field{"tolerances", &tolerances_of, ""},
      Field{"series", &MachineHistory::series,
            "every one of one machine, of several those with findings and tolerances"},
      Field{"groups", &MachineHistory::groups, "of tests that can be compared"}};
};

// A change of a bar, with the names of the machines.
struct BarChangeResult {
  BarChange change;
  std::vector<std::string> machines;
};
std::vector<BarChangeResult> bar_changes_of(const History& history);

template <>
struct ResultType<BarChangeResult> {
  static constexpr std::string_view name = "BarChange";
  static constexpr std::string_view meaning = "A change of the bar that machines are tested with.";
  static constexpr std::tuple fields{
      Field{"from", [](const BarChangeResult& of) { return of.change.from; }, "serial number"},
      Field{"to", [](const BarChangeResult& of) { return of.change.to; }, ""},
      Field{"machines", &BarChangeResult::machines, ""},
      Field{"step_um_per_m", [](const BarChangeResult& of) { return of.change.size_ppm; }, "mean step of the scales"},
      Field{"sigma_um_per_m", [](const BarChangeResult& of) { return of.change.sigma_ppm; }, ""}};
};

template <>
struct ResultType<History> {
  static constexpr std::string_view name = "Ranking";
  static constexpr std::string_view meaning = "Machines over their tests, what needs something first.";
  static constexpr std::tuple fields{
      Field{"machines", &History::machines, "what needs something first"},
      Field{"bar_changes", &bar_changes_of, ""},
      Field{"judged", &History::judged, "questions"},
      Field{"found", &History::found, "of these answered with yes"},
      Field{"false_discovery_rate", &History::false_discovery_rate, "share of those by chance"},
      Field{"without_date", &History::without_date, "files of tests that are in nothing"}};
};

struct HistoryResult {
  History history;
  MayLack<GeometryResult> geometry;
  std::vector<std::string> remarks;
  std::vector<SkippedTest> skipped;
};
HistoryResult result_of(const TestFiles& files, const History& history, const MachineGeometry& geometry);

template <>
struct ResultType<HistoryResult> {
  static constexpr std::string_view name = "History";
  static constexpr std::string_view meaning = "Machines over their tests.";
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&HistoryResult::history, ResultType<History>::fields),
                     std::tuple{Field{"geometry", &HistoryResult::geometry, "squareness and scales, of one machine"},
                                Field{"remarks", &HistoryResult::remarks, "of the readers"},
                                Field{"skipped", &HistoryResult::skipped, "files that could not be read"}});
};

}  // namespace ballbar

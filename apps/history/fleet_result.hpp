// What `fleet --json` prints: Fleet, whose parts name each other by their places, as results of their own.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/history/fleet.hpp"
#include "history/history_result.hpp"

namespace ballbar {

// What a finding or a tolerance says of a quantity.
template <class Part>
struct OfSeries {
  FleetSeries series;
  Part part;
};

inline constexpr std::tuple kQuantityFields{Field{"quantity", &FleetSeries::name, ""},
                                            Field{"plane", &FleetSeries::plane, "XY, YZ, ZX"},
                                            Field{"unit", &FleetSeries::unit, ""}};
inline constexpr std::tuple kLevelFields{Field{"level", &FleetSeries::level, "of the curve at the last test"},
                                         Field{"sigma", &FleetSeries::sigma, "of the level"}};

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

struct FleetFinding {
  Finding finding;
  std::vector<OfSeries<FindingQuantity>> quantities;
};

template <>
struct ResultType<FleetFinding> {
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
      std::tuple_cat(fields_through(&FleetFinding::finding, found),
                     std::tuple{Field{"quantities", &FleetFinding::quantities, "the clearest first"}});
};

template <>
struct ResultType<OfSeries<FleetTolerance>> {
  static constexpr std::string_view name = "FleetTolerance";
  static constexpr std::string_view meaning = "A tolerance, and when it is met.";
  static constexpr std::tuple met{
      Field{"lower", [](const FleetTolerance& of) { return of.tolerance.lower; }, "null: none"},
      Field{"upper", [](const FleetTolerance& of) { return of.tolerance.upper; }, ""},
      Field{"outlook", [](const FleetTolerance& of) { return of.date.outlook; },
            "beyond, expected, no_trend, not_within_10_years"},
      Field{"met", [](const FleetTolerance& of) { return day_of(of.date.at_s); }, "date; null: not told"},
      Field{"earliest", [](const FleetTolerance& of) { return day_of(of.date.earliest_s); }, ""},
      Field{"latest", [](const FleetTolerance& of) { return day_of(of.date.latest_s); }, ""},
      Field{"last_test_alone", &FleetTolerance::last_alone, "the last test is beyond, the level is not"}};
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&OfSeries<FleetTolerance>::series, std::tuple_cat(kQuantityFields, kLevelFields)),
                     fields_through(&OfSeries<FleetTolerance>::part, met));
};

template <>
struct ResultType<FleetSeries> {
  static constexpr std::string_view name = "FleetSeries";
  static constexpr std::string_view meaning = "A quantity of a machine over time.";
  static constexpr std::tuple fields =
      std::tuple_cat(kQuantityFields, kLevelFields,
                     std::tuple{Field{"scatter", &FleetSeries::scatter, "about the curve"},
                                Field{"dates",
                                      [](const FleetSeries& of) {
                                        std::vector<std::string> dates;
                                        for (const double time_s : of.time_s) dates.push_back(date_text(time_s));
                                        return dates;
                                      },
                                      ""},
                                Field{"values", &FleetSeries::value, ""}, Field{"fitted", &FleetSeries::fitted, ""}});
};

std::vector<FleetFinding> findings_of(const FleetMachine& machine);
std::vector<OfSeries<FleetTolerance>> tolerances_of(const FleetMachine& machine);

template <>
struct ResultType<FleetMachine> {
  static constexpr std::string_view name = "FleetMachine";
  static constexpr std::string_view meaning = "A machine, and what it needs.";
  static constexpr std::tuple fields{Field{"machine", &FleetMachine::name, "as its tests state it, else their folder"},
                                     Field{"tests", &FleetMachine::tests, "how many"},
                                     Field{"first", [](const FleetMachine& of) { return day_of(of.first_s); }, "date"},
                                     Field{"last", [](const FleetMachine& of) { return day_of(of.last_s); }, ""},
                                     Field{"need", &FleetMachine::need, "beyond, expected, finding, nothing"},
                                     Field{"reason", &FleetMachine::reason, "why it stands where it does"},
                                     Field{"findings", &findings_of, "the clearest first"},
                                     Field{"tolerances", &tolerances_of, ""},
                                     Field{"series", &FleetMachine::series, "of what findings and tolerances name"}};
};

// A change of a bar, with the names of the machines.
struct FleetBarChange {
  BarChange change;
  std::vector<std::string> machines;
};
std::vector<FleetBarChange> bar_changes_of(const Fleet& fleet);

template <>
struct ResultType<FleetBarChange> {
  static constexpr std::string_view name = "BarChange";
  static constexpr std::string_view meaning = "A change of the bar that machines are tested with.";
  static constexpr std::tuple fields{
      Field{"from", [](const FleetBarChange& of) { return of.change.from; }, "serial number"},
      Field{"to", [](const FleetBarChange& of) { return of.change.to; }, ""},
      Field{"machines", &FleetBarChange::machines, ""},
      Field{"step_um_per_m", [](const FleetBarChange& of) { return of.change.size_ppm; }, "mean step of the scales"},
      Field{"sigma_um_per_m", [](const FleetBarChange& of) { return of.change.sigma_ppm; }, ""}};
};

template <>
struct ResultType<Fleet> {
  static constexpr std::string_view name = "Fleet";
  static constexpr std::string_view meaning = "Many machines over their tests.";
  static constexpr std::tuple fields{
      Field{"machines", &Fleet::machines, "what needs something first"},
      Field{"bar_changes", &bar_changes_of, ""},
      Field{"judged", &Fleet::judged, "questions"},
      Field{"found", &Fleet::found, "of these answered with yes"},
      Field{"false_discovery_rate", &Fleet::false_discovery_rate, "share of those by chance"},
      Field{"without_date", &Fleet::without_date, "tests that are in nothing"}};
};

}  // namespace ballbar

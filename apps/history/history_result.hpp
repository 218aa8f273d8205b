// What `history --json` prints: MachineHistory, whose parts name tests by their places, as a result of its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/history/history.hpp"
#include "history/quantity_text.hpp"
#include "history/test_files.hpp"

namespace ballbar {

inline std::optional<std::string> day_of(const std::optional<double>& time_s) {
  return time_s ? std::optional(date_text(*time_s)) : std::nullopt;
}
inline std::optional<std::string> moment_of(const std::optional<std::int64_t>& time_s) {
  return time_s ? std::optional(iso_date_text(*time_s)) : std::nullopt;
}

template <>
struct ResultType<SkippedTest> {
  static constexpr std::string_view name = "SkippedTest";
  static constexpr std::string_view meaning = "A file that has no test of its own.";
  static constexpr std::tuple fields{
      Field{"file", &SkippedTest::file, ""}, Field{"sentence", &SkippedTest::sentence, "with the file's name"},
      Field{"copy_of", &SkippedTest::copy_of, "file of whose test it is one; null: none"}};
};

struct LastValue {
  double value = 0.0, sigma = 0.0;
  bool significant = false;
  MayLack<std::optional<std::string>> date;
};

template <>
struct ResultType<LastValue> {
  static constexpr std::string_view name = "LastValue";
  static constexpr std::string_view meaning = "A quantity in the newest test.";
  static constexpr std::tuple fields{
      Field{"value", &LastValue::value, ""}, Field{"sigma", &LastValue::sigma, "null: not known"},
      Field{"significant", &LastValue::significant, ""}, Field{"date", &LastValue::date, "of tests with one"}};
};

template <>
struct ResultType<QuantityChange> {
  static constexpr std::string_view name = "QuantityChange";
  static constexpr std::string_view meaning = "A change since the test before.";
  static constexpr std::tuple fields{
      Field{"since", [](const QuantityChange& of) { return iso_date_text(of.since_s); }, "date"},
      Field{"value", &QuantityChange::value, ""}, Field{"sigma", &QuantityChange::sigma, "null: not known"},
      Field{"significant", &QuantityChange::significant, ""}};
};

template <>
struct ResultType<Trend> {
  static constexpr std::string_view name = "Trend";
  static constexpr std::string_view meaning = "A straight line over time.";
  static constexpr std::tuple fields{Field{"rate_per_year", &Trend::rate_per_year, ""},
                                     Field{"sigma_per_year", &Trend::sigma_per_year, ""},
                                     Field{"significant", &Trend::significant, ""},
                                     Field{"scatter", &Trend::scatter, "from test to test beyond the sigmas"},
                                     Field{"tests", &Trend::tests, "how many"}};
};

struct MetTolerance {
  Tolerance tolerance;
  ToleranceDate date;
};

template <>
struct ResultType<MetTolerance> {
  using Met = const MetTolerance&;
  static constexpr std::string_view name = "Tolerance";
  static constexpr std::string_view meaning = "A tolerance, and when it is met.";
  static constexpr std::tuple fields{
      Field{"lower", [](Met of) { return of.tolerance.lower; }, "null: none"},
      Field{"upper", [](Met of) { return of.tolerance.upper; }, ""},
      Field{"outlook", [](Met of) { return of.date.outlook; }, "beyond, expected, no_trend, not_within_10_years"},
      Field{"met", [](Met of) { return day_of(of.date.at_s); }, "date; null: not told"},
      Field{"earliest", [](Met of) { return day_of(of.date.earliest_s); }, ""},
      Field{"latest", [](Met of) { return day_of(of.date.latest_s); }, ""}};
};

struct QuantityResult {
  QuantityHistory quantity;
  LastValue last;
};

template <>
struct ResultType<QuantityResult> {
  using Quantity = const QuantityHistory&;
  static constexpr std::string_view name = "QuantityHistory";
  static constexpr std::string_view meaning = "A quantity of a machine over its tests.";
  static constexpr std::tuple named{Field{"name", &QuantityHistory::name, ""},
                                    Field{"unit", &QuantityHistory::unit, ""},
                                    Field{"of_set_up", &QuantityHistory::of_set_up, "it says nothing of the machine"}};
  static constexpr std::tuple over_time{
      Field{"change", [](Quantity of) { return MayLack<QuantityChange>{of.change}; }, "since the test before"},
      Field{"trend", [](Quantity of) { return MayLack<Trend>{of.trend}; }, ""},
      Field{"tolerance",
            [](Quantity of) {
              return MayLack<MetTolerance>{of.tolerance ? std::optional(MetTolerance{*of.tolerance, *of.date})
                                                        : std::nullopt};
            },
            "where there is one"}};
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&QuantityResult::quantity, named),
                     std::tuple{Field{"last", &QuantityResult::last, "in the newest test"}},
                     fields_through(&QuantityResult::quantity, over_time));
};

struct TestOfGroup {
  std::string file;
  std::optional<std::string> date;
  bool stored = false;
};

template <>
struct ResultType<TestOfGroup> {
  static constexpr std::string_view name = "TestOfGroup";
  static constexpr std::string_view meaning = "A test of a group.";
  static constexpr std::tuple fields{Field{"file", &TestOfGroup::file, ""},
                                     Field{"date", &TestOfGroup::date, "null: not stated"},
                                     Field{"stored", &TestOfGroup::stored, "values of the file, without readings"}};
};

struct GroupResult {
  TestGroup group;
  std::vector<TestOfGroup> tests;
  std::vector<QuantityResult> quantities;
};

template <>
struct ResultType<GroupResult> {
  static constexpr std::string_view name = "TestGroup";
  static constexpr std::string_view meaning = "Tests that can be compared.";
  static constexpr std::tuple driven{Field{"plane", &TestGroup::plane, "XY, YZ, ZX"},
                                     Field{"bar", &TestGroup::bar, "its serial number; empty: not stated"},
                                     Field{"length_mm", &TestGroup::nominal_length_mm, ""},
                                     Field{"feed_mm_per_min", &TestGroup::feed_mm_per_min, "null: not stated"},
                                     Field{"start_deg", &TestGroup::start_deg, ""},
                                     Field{"arc_deg", &TestGroup::arc_deg, ""}};
  static constexpr std::tuple fields = std::tuple_cat(
      fields_through(&GroupResult::group, driven),
      std::tuple{Field{"tests", &GroupResult::tests, "by date"}, Field{"quantities", &GroupResult::quantities, ""}});
};

struct SquarenessResult {
  PlaneSquareness squareness;
  std::vector<std::string> files;
};

template <>
struct ResultType<SquarenessResult> {
  using Of = const SquarenessResult&;
  static constexpr std::string_view name = "PlaneSquareness";
  static constexpr std::string_view meaning = "How far a plane is out of square.";
  static constexpr std::tuple fields{
      Field{"plane", [](Of of) { return of.squareness.plane; }, ""},
      Field{"value", [](Of of) { return of.squareness.value; }, "um/m"},
      Field{"sigma", [](Of of) { return of.squareness.sigma; }, ""},
      Field{"p_value", [](Of of) { return of.squareness.p_value; }, "of tests that differ as much by chance"},
      Field{"files", &SquarenessResult::files, "that it is from"}};
};

constexpr auto letter_of(auto member) {
  return [member](const auto& of) { return std::string(1, "XYZ"[of.*member]); };
}

template <>
struct ResultType<AxisScale> {
  static constexpr std::string_view name = "AxisScale";
  static constexpr std::string_view meaning = "The scale of an axis.";
  static constexpr std::tuple fields{
      Field{"axis", letter_of(&AxisScale::axis), "X, Y, Z"}, Field{"value", &AxisScale::value_ppm, "um/m"},
      Field{"sigma", &AxisScale::sigma_ppm, ""}, Field{"planes", &AxisScale::planes, "that it is measured in"}};
};

struct PullResult {
  ScalePull pull;
  std::string file;
  Plane plane = Plane::XY;
};

template <>
struct ResultType<PullResult> {
  static constexpr std::string_view name = "ScalePull";
  static constexpr std::string_view meaning = "The scale of an axis in one test.";
  static constexpr std::tuple pulled{
      Field{"axis", letter_of(&ScalePull::axis), "X, Y, Z"}, Field{"value", &ScalePull::value_ppm, "um/m"},
      Field{"sigma", &ScalePull::sigma_ppm, ""},
      Field{"pull", &ScalePull::pull, "what is left over its sigma; null: only this test tells the axis"}};
  static constexpr std::tuple fields =
      std::tuple_cat(std::tuple{Field{"file", &PullResult::file, ""}, Field{"plane", &PullResult::plane, ""}},
                     fields_through(&PullResult::pull, pulled));
};

struct AgreementOfTests {
  double chi2 = 0.0;
  std::size_t degrees = 0;
  double p_value = 0.0, scatter_ppm = 0.0;
  std::vector<PullResult> pulls;
};

template <>
struct ResultType<AgreementOfTests> {
  static constexpr std::string_view name = "AgreementOfTests";
  static constexpr std::string_view meaning = "Whether tests of several planes agree.";
  static constexpr std::tuple fields{
      Field{"chi2", &AgreementOfTests::chi2, ""},
      Field{"degrees", &AgreementOfTests::degrees, "of freedom; 0: nothing to compare"},
      Field{"p_value", &AgreementOfTests::p_value, ""},
      Field{"scatter_um_per_m", &AgreementOfTests::scatter_ppm, "of each scale beyond its sigma, where they disagree"},
      Field{"pulls", &AgreementOfTests::pulls, "a row a scale and test"}};
};

struct GeometryResult {
  bool within_a_day = true;
  std::vector<SquarenessResult> squareness;
  std::vector<AxisScale> scales;
  AgreementOfTests agreement;
};

template <>
struct ResultType<GeometryResult> {
  static constexpr std::string_view name = "MachineGeometry";
  static constexpr std::string_view meaning = "Squareness and scales of a machine.";
  static constexpr std::tuple fields{Field{"within_a_day", &GeometryResult::within_a_day, "whether all tests are"},
                                     Field{"out_of_square_um_per_m", &GeometryResult::squareness, "a row a plane"},
                                     Field{"scales_um_per_m", &GeometryResult::scales, "a row an axis"},
                                     Field{"agreement", &GeometryResult::agreement, "of the tests"}};
};

struct MachineResult {
  std::string machine;
  std::size_t changes = 0, trends = 0;
  std::vector<GroupResult> groups;
  GeometryResult geometry;
};

template <>
struct ResultType<MachineResult> {
  static constexpr std::string_view name = "MachineHistory";
  static constexpr std::string_view meaning = "A machine over its tests.";
  static constexpr std::tuple fields{Field{"machine", &MachineResult::machine, "empty: no test names one"},
                                     Field{"changes_judged", &MachineResult::changes, ""},
                                     Field{"trends_judged", &MachineResult::trends, ""},
                                     Field{"groups", &MachineResult::groups, "of tests that can be compared"},
                                     Field{"geometry", &MachineResult::geometry, "squareness and scales"}};
};

struct HistoryResult {
  std::vector<MachineResult> machines;
  std::vector<std::string> without_date, remarks;
  std::vector<SkippedTest> skipped;
};
HistoryResult result_of(const TestFiles& files, const std::vector<MachineHistory>& machines);

template <>
struct ResultType<HistoryResult> {
  static constexpr std::string_view name = "History";
  static constexpr std::string_view meaning = "Machines over their tests.";
  static constexpr std::tuple fields{
      Field{"machines", &HistoryResult::machines, "with groups of tests, their quantities, and geometry"},
      Field{"without_date", &HistoryResult::without_date, "files"},
      Field{"remarks", &HistoryResult::remarks, "of the readers"},
      Field{"skipped", &HistoryResult::skipped, "files that could not be read"}};
};

template <>
struct ResultType<TestQuantity> {
  static constexpr std::string_view name = "TestQuantity";
  static constexpr std::string_view meaning = "An error, or a quantity, of a test.";
  static constexpr std::tuple fields{
      Field{"name", &TestQuantity::name, ""},
      Field{"value", &TestQuantity::value, ""},
      Field{"sigma", &TestQuantity::sigma, "null: not known"},
      Field{"unit", &TestQuantity::unit, ""},
      Field{"significant", &TestQuantity::significant, "whether the test shows it"},
      Field{"rank", &TestQuantity::rank, "by what mending it gains, 1 the most; null: none"},
      Field{"of_set_up", &TestQuantity::of_set_up, "it says nothing of the machine"}};
};

template <>
struct ResultType<MachineTest> {
  static constexpr std::string_view name = "MachineTest";
  static constexpr std::string_view meaning = "A test of a machine.";
  static constexpr std::tuple fields{
      Field{"file", &MachineTest::file, ""},
      Field{"machine", &MachineTest::machine, "empty: not stated"},
      Field{"bar", &MachineTest::bar, "its serial number; empty: not stated"},
      Field{"date", [](const MachineTest& of) { return moment_of(of.started_s); }, "null: not stated"},
      Field{"plane", &MachineTest::plane, "XY, YZ, ZX"},
      Field{"nominal_length_mm", &MachineTest::nominal_length_mm, ""},
      Field{"feed_mm_per_min", &MachineTest::feed_mm_per_min, "null: not stated"},
      Field{"start_deg", &MachineTest::start_deg, "of the readings, counter-clockwise"},
      Field{"arc_deg", &MachineTest::arc_deg, ""},
      Field{"stored", &MachineTest::stored, "values of the file, without readings"},
      Field{"errors", &MachineTest::quantities, ""}};
};

template <>
struct ResultType<TestFiles> {
  static constexpr std::string_view name = "Errors";
  static constexpr std::string_view meaning = "The errors of many ballbar tests.";
  static constexpr std::tuple fields{Field{"tests", &TestFiles::tests, "a row a test"},
                                     Field{"remarks", &TestFiles::remarks, "of the readers"},
                                     Field{"skipped", &TestFiles::skipped, "files that could not be read"}};
};

}  // namespace ballbar

// Drifts, as results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/drift/five_probes.hpp"
#include "ballbar/drift/thermal_test.hpp"
#include "ballbar/formats/results/message.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Of an estimate that a test may lack.
template <class Type>
constexpr auto value_um(std::optional<Estimate> Type::*member) {
  return [member](const Type& of) {
    return MayLack<double>{of.*member ? std::optional((*(of.*member)).value_um) : std::nullopt};
  };
}
template <class Type>
constexpr auto sigma_um(std::optional<Estimate> Type::*member) {
  return [member](const Type& of) {
    return MayLack<double>{of.*member ? std::optional((*(of.*member)).sigma_um) : std::nullopt};
  };
}

inline constexpr auto kDriftPointValues =
    std::tuple{Field{"x_um", value_um(&DriftPoint::x), ""},
               Field{"y_um", value_um(&DriftPoint::y), ""},
               Field{"z_um", value_um(&DriftPoint::z), ""},
               Field{"radial_um", value_um(&DriftPoint::radial), ""},
               Field{"axial_um", value_um(&DriftPoint::axial), ""},
               Field{"shift_a_um", value_um(&DriftPoint::shift_a), "of the radial one, in the frame that turns"},
               Field{"shift_b_um", value_um(&DriftPoint::shift_b), ""},
               Field{"radius_change_um", value_um(&DriftPoint::radius_change), "of the circle, or the path about C"},
               Field{"radius_change_a_um", value_um(&DriftPoint::radius_change_a), "of the path about A"}};
inline constexpr auto kDriftPointSigmas =
    std::tuple{Field{"x_sigma_um", sigma_um(&DriftPoint::x), ""},
               Field{"y_sigma_um", sigma_um(&DriftPoint::y), ""},
               Field{"z_sigma_um", sigma_um(&DriftPoint::z), ""},
               Field{"radial_sigma_um", sigma_um(&DriftPoint::radial), ""},
               Field{"axial_sigma_um", sigma_um(&DriftPoint::axial), ""},
               Field{"shift_a_sigma_um", sigma_um(&DriftPoint::shift_a), ""},
               Field{"shift_b_sigma_um", sigma_um(&DriftPoint::shift_b), ""},
               Field{"radius_change_sigma_um", sigma_um(&DriftPoint::radius_change), ""},
               Field{"radius_change_a_sigma_um", sigma_um(&DriftPoint::radius_change_a), ""}};
inline constexpr auto kDriftPointElongation =
    Field{"elongation_correction_um", [](const DriftPoint& of) { return MayLack<double>{of.elongation_correction_um}; },
          "taken off the radial test"};

constexpr auto combined(double Estimate::*value) {
  return [value](const DriftPoint& of) {
    const std::optional<Estimate> all = combined_drift(of);
    return MayLack<double>{all ? std::optional((*all).*value) : std::nullopt};
  };
}

template <>
inline constexpr auto kResult<DriftPoint> = ResultType{
    "DriftPoint", "What a test says of the drift, as far as its method tells it.",
    std::tuple_cat(
        std::tuple{Field{"time_s", known(&DriftPoint::time_s), "of the test"}}, kDriftPointValues, kDriftPointSigmas,
        std::tuple{kDriftPointElongation,
                   Field{"combined_um", combined(&Estimate::value_um), "root of the sum of squares of x, y and z"},
                   Field{"combined_sigma_um", combined(&Estimate::sigma_um), ""},
                   Field{"correlation_y_z", [](const DriftPoint& of) { return MayLack<double>{of.correlation_y_z}; },
                         "of the test's own y and z"}})};

template <>
inline constexpr auto kResult<Position> =
    ResultType{"Position", "Where a test found the ball of the spindle, errors of the set-up included.",
               std::tuple{Field{"time_s", known(&Position::time_s), "of the test"},
                          Field{"x_um", value_um(&Position::x), "from the point where the axes meet"},
                          Field{"x_sigma_um", sigma_um(&Position::x), ""}, Field{"y_um", value_um(&Position::y), ""},
                          Field{"y_sigma_um", sigma_um(&Position::y), ""}, Field{"z_um", value_um(&Position::z), ""},
                          Field{"z_sigma_um", sigma_um(&Position::z), ""},
                          Field{"centre_a_um", value_um(&Position::centre_a), "of the circle"},
                          Field{"centre_a_sigma_um", sigma_um(&Position::centre_a), ""},
                          Field{"centre_b_um", value_um(&Position::centre_b), ""},
                          Field{"centre_b_sigma_um", sigma_um(&Position::centre_b), ""},
                          Field{"length_mm", [](const Position& of) { return MayLack<double>{of.length_mm}; }, "axial"},
                          Field{"radius_mm", &Position::radius_mm, ""},
                          Field{"converged", &Position::converged, "whether the fit came to an end"},
                          Field{"discounted", &Position::discounted, "readings, with --robust"}}};

template <>
inline constexpr auto kResult<DriftSeries> = ResultType{
    "DriftOfTests", "The drift of the spindle from tests.",
    std::tuple{Field{"method", &DriftSeries::method, "spindle_rotation, two_arcs, circles; of five probes five_probe"},
               Field{"reference_s", known(&DriftSeries::reference_s), "time of the test that drift is taken to"},
               Field{"points", &DriftSeries::points, "one row per test"},
               Field{"positions", &DriftSeries::positions, "the same before the reference is taken off"},
               Field{"not_cancelled", &DriftSeries::not_cancelled, "what of the set-up remains"}}};

// Changes of an axis over a stretch of time.
struct AxisRange {
  DriftRange range;
  std::string unit;
};
constexpr auto range_value(std::optional<Estimate> DriftRange::*member, double Estimate::*value) {
  return [member, value](const AxisRange& of) {
    const std::optional<Estimate>& part = of.range.*member;
    return OfUnit<MayLack<double>>{{part ? std::optional((*part).*value) : std::nullopt}, of.unit};
  };
}

template <>
inline constexpr auto kResult<AxisRange> = ResultType{
    "AxisRange", "Largest less smallest of an axis over a stretch of time.",
    std::tuple{Field{"first_60_min", range_value(&DriftRange::first_60_min, &Estimate::value_um), ""},
               Field{"first_60_min_sigma", range_value(&DriftRange::first_60_min, &Estimate::sigma_um), ""},
               Field{"after_60_min", range_value(&DriftRange::after_60_min, &Estimate::value_um), ""},
               Field{"after_60_min_sigma", range_value(&DriftRange::after_60_min, &Estimate::sigma_um), ""},
               Field{"last_60_min", range_value(&DriftRange::last_60_min, &Estimate::value_um), "of longer stretches"},
               Field{"last_60_min_sigma", range_value(&DriftRange::last_60_min, &Estimate::sigma_um), ""},
               Field{"total", range_value(&DriftRange::total, &Estimate::value_um), ""},
               Field{"total_sigma", range_value(&DriftRange::total, &Estimate::sigma_um), ""},
               Field{"first_to_last", range_value(&DriftRange::at_end, &Estimate::value_um), "the last less the first"},
               Field{"first_to_last_sigma", range_value(&DriftRange::at_end, &Estimate::sigma_um), ""}}};

template <>
inline constexpr auto kResult<AxisSettling> = ResultType{
    "AxisSettling", "When an axis is stable, from the first row of the stretch on.",
    std::tuple{Field{"axis", &AxisSettling::axis, ""},
               Field{"band_um", &AxisSettling::band_um, "about the final value"},
               Field{"is_small", &AxisSettling::is_small, "the whole stretch lies within the band"},
               Field{"stable", &AxisSettling::stable, "null: the rows do not determine it, or all lies in the band"}}};
template <>
inline constexpr auto kResult<StableTime> =
    ResultType{"StableTime", "From when on a drift stays within a band of its final value.",
               std::tuple{Field{"time_s", known(&StableTime::time_s), "from the first row of the stretch"},
                          Field{"sigma_s", &StableTime::sigma_s, ""},
                          Field{"reached", &StableTime::reached, "whether the stretch lasts as long"},
                          Field{"final_um", &StableTime::final_um, "what the drift of the stretch tends to"},
                          Field{"final_sigma_um", &StableTime::final_sigma_um, ""},
                          Field{"share_at_end", &StableTime::share_at_end, "of it, at the last row of the stretch"}}};

template <>
inline constexpr auto kResult<TemperatureSpan> =
    ResultType{"TemperatureSpan", "A temperature during a thermal test.",
               std::tuple{Field{"column", &TemperatureSpan::column, ""}, Field{"role", &TemperatureSpan::role, ""},
                          Field{"first_degC", &TemperatureSpan::first_degC, ""},
                          Field{"least_degC", &TemperatureSpan::least_degC, ""},
                          Field{"largest_degC", &TemperatureSpan::largest_degC, ""}}};
template <>
inline constexpr auto kResult<ThermalTest> =
    ResultType{"ThermalTest", "Which thermal test a record is, and what it lacks.",
               std::tuple{Field{"kind", &ThermalTest::kind,
                                "unknown, environment (ETVE), spindle, spindle_spectrum, linear_axes or rotary_axes"},
                          Field{"motion", &ThermalTest::motion, "the column that shows it"},
                          Field{"motion_unit", &ThermalTest::motion_unit, "rpm, mm_per_min, deg_per_min"},
                          Field{"from_s", &ThermalTest::from_s, ""}, Field{"duration_s", &ThermalTest::duration_s, ""},
                          Field{"running_s", &ThermalTest::running_s, "the spindle turns, or the axis moves"},
                          Field{"rest_after_s", &ThermalTest::rest_after_s, "from its last stop to the end"},
                          Field{"speeds", &ThermalTest::speeds, "in motion_unit, each for 5 % of that time and more"},
                          Field{"temperatures", &ThermalTest::temperatures, "those of the room first"},
                          Field{"lacks", &ThermalTest::lacks,
                                "speed, room_temperature, structure_temperature, a_day, rest_after"}}};
template <>
inline constexpr auto kResult<LargestDrift> =
    ResultType{"LargestDrift", "The largest drift from the reference in an axis.",
               std::tuple{Field{"axis", &LargestDrift::axis, "combined: of x, y and z"},
                          Field{"drift",
                                [](const LargestDrift& of) {
                                  return OfUnit<double>{of.drift.value_um, of.unit};
                                },
                                ""},
                          Field{"drift_sigma",
                                [](const LargestDrift& of) {
                                  return OfUnit<double>{of.drift.sigma_um, of.unit};
                                },
                                ""},
                          Field{"time_s", known(&LargestDrift::time_s), ""}}};

template <>
inline constexpr auto kResult<CourseStep> =
    ResultType{"CourseStep", "A step in readings.",
               std::tuple{Field{"time_s", known(&CourseStep::time_s), "of the first reading after it"},
                          Field{"value_um", [](const CourseStep& of) { return of.size.value_um; }, ""},
                          Field{"sigma_um", [](const CourseStep& of) { return of.size.sigma_um; }, ""}}};
struct AxisCourse {
  std::string axis;
  Course course;
};
template <>
inline constexpr auto kResult<AxisCourse> = ResultType{
    "AxisCourse", "The course of readings without any input.",
    std::tuple{
        Field{"axis", &AxisCourse::axis, ""},
        Field{"shape", [](const AxisCourse& of) { return of.course.shape; }, "still, trend, decay, or none of them"},
        Field{"probability", [](const AxisCourse& of) { return of.course.probability; }, "of that shape; null: none"},
        Field{"trend_um_per_h", [](const AxisCourse& of) { return of.course.trend_um_per_h.value_um; }, ""},
        Field{"trend_sigma_um_per_h", [](const AxisCourse& of) { return of.course.trend_um_per_h.sigma_um; }, ""},
        Field{"decay_um", [](const AxisCourse& of) { return of.course.decay.value_um; }, "change in the end"},
        Field{"decay_sigma_um", [](const AxisCourse& of) { return of.course.decay.sigma_um; }, ""},
        Field{"tau_s", [](const AxisCourse& of) { return of.course.time_constant_s; }, "its time constant"},
        Field{"steps", [](const AxisCourse& of) { return of.course.steps; }, ""},
        Field{"noise_um", [](const AxisCourse& of) { return of.course.noise_um; }, "of a reading"}}};

// What stands on the sheet of a thermal test.
struct DriftSheet {
  ThermalTest test;
  std::vector<LargestDrift> largest;
  TableOf<AxisRange> ranges, in_motion;  // of the record, and of its only stretch in motion
  std::vector<AxisSettling> settling;    // of one speed, or of the stretch in motion
  std::vector<AxisCourse> courses;       // where nothing else was logged
};
inline constexpr auto kSheetFields =
    std::tuple{Field{"thermal_test", &DriftSheet::test, "which it is, and what it lacks"},
               Field{"largest", &DriftSheet::largest, "of each axis, and combined"},
               Field{"ranges", &DriftSheet::ranges, "by axis"},
               Field{"ranges_in_motion", &DriftSheet::in_motion, "of the only stretch of one speed or feed"},
               Field{"stability", &DriftSheet::settling,
                     "when each axis is stable, of a record of one speed, or of its only stretch in motion"},
               Field{"courses", &DriftSheet::courses, "trend and steps, where nothing but the drift was logged"}};

template <>
inline constexpr auto kResult<DriftSheet> =
    ResultType{"DriftSheet", "What stands on the sheet of a thermal test.", kSheetFields};

// A step of the speed.
struct StepRange {
  double from_s = 0.0, to_s = 0.0, speed = 0.0;
  std::string unit;  // of the speed: "rpm"
  TableOf<AxisRange> ranges;
  std::vector<AxisSettling> settling;
};

template <>
inline constexpr auto kResult<StepRange> = ResultType{
    "SpeedStep", "A stretch of one speed.",
    std::tuple{Field{"from_s", &StepRange::from_s, ""}, Field{"to_s", &StepRange::to_s, ""},
               Field{"speed",
                     [](const StepRange& of) {
                       return OfUnit<double>{of.speed, of.unit};
                     },
                     ""},
               Field{"ranges", &StepRange::ranges, "by axis"}, Field{"stability", &StepRange::settling, "by axis"}}};

struct FiveProbeDrift {
  std::string method;
  double reference_s = 0.0;
  Series points;
  std::vector<StepRange> steps;
  DriftSheet sheet;
  std::vector<Paragraph> remarks;
};

// A row of a series; there may be a million, which are written one by one.
struct SeriesRow {
  double time_s = 0.0;
  KeysOf<double> values;
};
template <>
inline constexpr auto kResult<SeriesRow> = ResultType{
    "SeriesRow", "A row of a series.",
    std::tuple{Field{"time_s", known(&SeriesRow::time_s), ""}, Field{"COLUMN", &SeriesRow::values, "a key a column"}}};
template <>
struct SchemaOf<Series> {
  static ValueSchema of(std::vector<ResultSchema>& all) { return SchemaOf<std::vector<SeriesRow>>::of(all); }
};

template <>
inline constexpr auto kResult<FiveProbeDrift> = ResultType{
    "DriftOfProbes", "The drift of the spindle from five probes, or as a log has it.",
    std::tuple_cat(
        std::tuple{Field{"method", &FiveProbeDrift::method, "five_probe, or log"},
                   Field{"reference_s", known(&FiveProbeDrift::reference_s), "time that drift is taken to"},
                   Field{"points", &FiveProbeDrift::points, "one row per time, AXIS_um or AXIS_urad with sigma"},
                   Field{"steps", &FiveProbeDrift::steps, "changes of the speed"}},
        fields_through(&FiveProbeDrift::sheet, kSheetFields),
        std::tuple{Field{"remarks", &FiveProbeDrift::remarks, ""}})};

}  // namespace ballbar

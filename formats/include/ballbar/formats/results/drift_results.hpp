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

// The fields of an estimate, its value and its sigma, which a result may lack; and of one with the unit of the result.
template <class... Gets>
constexpr auto estimate(std::string_view value, std::string_view sigma, std::string_view meaning, Gets... gets) {
  return FieldList{Field{value, may_lack(in(gets..., &Estimate::value_um)), meaning},
                   Field{sigma, may_lack(in(gets..., &Estimate::sigma_um))}};
}
template <class... Gets>
constexpr auto estimate_with_unit(std::string_view value, std::string_view sigma, std::string_view meaning,
                                  Gets... gets) {
  return FieldList{Field{value, with_unit(may_lack(in(gets..., &Estimate::value_um))), meaning},
                   Field{sigma, with_unit(may_lack(in(gets..., &Estimate::sigma_um)))}};
}

// What is drawn and written as columns.
inline constexpr auto kDriftPointColumns = FieldList(
    estimate("x_um", "x_sigma_um", "", &DriftPoint::x), estimate("y_um", "y_sigma_um", "", &DriftPoint::y),
    estimate("z_um", "z_sigma_um", "", &DriftPoint::z),
    estimate("radial_um", "radial_sigma_um", "", &DriftPoint::radial),
    estimate("axial_um", "axial_sigma_um", "", &DriftPoint::axial),
    estimate("shift_a_um", "shift_a_sigma_um", "of the radial one, in the frame that turns", &DriftPoint::shift_a),
    estimate("shift_b_um", "shift_b_sigma_um", "", &DriftPoint::shift_b),
    estimate("radius_change_um", "radius_change_sigma_um", "of the circle, or the path about C",
             &DriftPoint::radius_change),
    estimate("radius_change_a_um", "radius_change_a_sigma_um", "of the path about A", &DriftPoint::radius_change_a),
    Field{"elongation_correction_um", may_lack(&DriftPoint::elongation_correction_um), "taken off the radial test"});

template <>
inline constexpr auto kResult<DriftPoint> = ResultType(
    "DriftPoint", "What a test says of the drift, as far as its method tells it.",
    Field{"time_s", known(&DriftPoint::time_s), "of the test"}, kDriftPointColumns,
    estimate("combined_um", "combined_sigma_um", "root of the sum of squares of x, y and z", &combined_drift),
    Field{"correlation_y_z", may_lack(&DriftPoint::correlation_y_z), "of the test's own y and z"});

template <>
inline constexpr auto kResult<Position> =
    ResultType("Position", "Where a test found the ball of the spindle, errors of the set-up included.",
               Field{"time_s", known(&Position::time_s), "of the test"},
               estimate("x_um", "x_sigma_um", "from the point where the axes meet", &Position::x),
               estimate("y_um", "y_sigma_um", "", &Position::y), estimate("z_um", "z_sigma_um", "", &Position::z),
               estimate("centre_a_um", "centre_a_sigma_um", "of the circle", &Position::centre_a),
               estimate("centre_b_um", "centre_b_sigma_um", "", &Position::centre_b),
               Field{"length_mm", may_lack(&Position::length_mm), "axial"}, Field{"radius_mm", &Position::radius_mm},
               Field{"converged", &Position::converged, "whether the fit came to an end"},
               Field{"discounted", &Position::discounted, "readings, with --robust"});

template <>
inline constexpr auto kResult<DriftSeries> =
    ResultType("DriftOfTests", "The drift of the spindle from tests.",
               Field{"method", &DriftSeries::method, "spindle_rotation, two_arcs, circles; of five probes five_probe"},
               Field{"reference_s", known(&DriftSeries::reference_s), "time of the test that drift is taken to"},
               Field{"points", &DriftSeries::points, "one row per test"},
               Field{"positions", &DriftSeries::positions, "the same before the reference is taken off"},
               Field{"not_cancelled", &DriftSeries::not_cancelled, "what of the set-up remains"});

template <>
inline constexpr auto kResult<DriftRange> = ResultType(
    "AxisRange", "Largest less smallest of an axis over a stretch of time.",
    estimate_with_unit("first_60_min", "first_60_min_sigma", "", &DriftRange::first_60_min),
    estimate_with_unit("after_60_min", "after_60_min_sigma", "", &DriftRange::after_60_min),
    estimate_with_unit("last_60_min", "last_60_min_sigma", "of longer stretches", &DriftRange::last_60_min),
    estimate_with_unit("total", "total_sigma", "", &DriftRange::total),
    estimate_with_unit("first_to_last", "first_to_last_sigma", "the last less the first", &DriftRange::at_end));

template <>
inline constexpr auto kResult<AxisSettling> =
    ResultType("AxisSettling", "When an axis is stable, from the first row of the stretch on.",
               Field{"axis", &AxisSettling::axis}, Field{"band_um", &AxisSettling::band_um, "about the final value"},
               Field{"is_small", &AxisSettling::is_small, "the whole stretch lies within the band"},
               Field{"stable", &AxisSettling::stable, "null: the rows do not determine it, or all lies in the band"});
template <>
inline constexpr auto kResult<StableTime> = ResultType(
    "StableTime", "From when on a drift stays within a band of its final value.",
    Field{"time_s", known(&StableTime::time_s), "from the first row of the stretch"},
    Field{"sigma_s", &StableTime::sigma_s}, Field{"reached", &StableTime::reached, "whether the stretch lasts as long"},
    Field{"final_um", &StableTime::final_um, "what the drift of the stretch tends to"},
    Field{"final_sigma_um", &StableTime::final_sigma_um},
    Field{"share_at_end", &StableTime::share_at_end, "of it, at the last row of the stretch"});

template <>
inline constexpr auto kResult<TemperatureSpan> = ResultType("TemperatureSpan", "A temperature during a thermal test.",
                                                            Field{"column", &TemperatureSpan::column},
                                                            Field{"role", &TemperatureSpan::role},
                                                            Field{"first_degC", &TemperatureSpan::first_degC},
                                                            Field{"least_degC", &TemperatureSpan::least_degC},
                                                            Field{"largest_degC", &TemperatureSpan::largest_degC});
template <>
inline constexpr auto kResult<ThermalTest> = ResultType(
    "ThermalTest", "Which thermal test a record is, and what it lacks.",
    Field{"kind", &ThermalTest::kind,
          "unknown, environment (ETVE), spindle, spindle_spectrum, linear_axes or rotary_axes"},
    Field{"motion", &ThermalTest::motion, "the column that shows it"},
    Field{"motion_unit", &ThermalTest::motion_unit, "rpm, mm_per_min, deg_per_min"},
    Field{"from_s", &ThermalTest::from_s}, Field{"duration_s", &ThermalTest::duration_s},
    Field{"running_s", &ThermalTest::running_s, "the spindle turns, or the axis moves"},
    Field{"rest_after_s", &ThermalTest::rest_after_s, "from its last stop to the end"},
    Field{"speeds", &ThermalTest::speeds, "in motion_unit, each for 5 % of that time and more"},
    Field{"temperatures", &ThermalTest::temperatures, "those of the room first"},
    Field{"lacks", &ThermalTest::lacks, "speed, room_temperature, structure_temperature, a_day, rest_after"});
template <>
inline constexpr auto kResult<LargestDrift> = ResultType("LargestDrift",
                                                         "The largest drift from the reference in an axis.",
                                                         Field{"axis", &LargestDrift::axis, "combined: of x, y and z"},
                                                         estimate_with_unit("drift", "drift_sigma", "",
                                                                            &LargestDrift::drift),
                                                         Field{"time_s", known(&LargestDrift::time_s)});

template <>
inline constexpr auto kResult<CourseStep> = ResultType("CourseStep", "A step in readings.",
                                                       Field{"time_s", known(&CourseStep::time_s),
                                                             "of the first reading after it"},
                                                       estimate("value_um", "sigma_um", "", &CourseStep::size));
template <>
inline constexpr auto kResult<Course> =
    ResultType("AxisCourse", "The course of readings without any input.", Field{"axis", &Course::axis},
               Field{"shape", &Course::shape, "still, trend, decay, or none of them"},
               Field{"probability", &Course::probability, "of that shape; null: none"},
               estimate("trend_um_per_h", "trend_sigma_um_per_h", "", &Course::trend_um_per_h),
               estimate("decay_um", "decay_sigma_um", "change in the end", &Course::decay),
               Field{"tau_s", &Course::time_constant_s, "its time constant"}, Field{"steps", &Course::steps},
               Field{"noise_um", &Course::noise_um, "of a reading"});

// What stands on the sheet of a thermal test.
struct DriftSheet {
  ThermalTest test;
  std::vector<LargestDrift> largest;
  TableOf<DriftRange> ranges, in_motion;  // of the record, and of its only stretch in motion
  std::vector<AxisSettling> settling;     // of one speed, or of the stretch in motion
  std::vector<Course> courses;            // where nothing else was logged
};
template <>
inline constexpr auto kResult<DriftSheet> =
    ResultType("DriftSheet", "What stands on the sheet of a thermal test.",
               Field{"thermal_test", &DriftSheet::test, "which it is, and what it lacks"},
               Field{"largest", &DriftSheet::largest, "of each axis, and combined"},
               Field{"ranges", &DriftSheet::ranges, "by axis"},
               Field{"ranges_in_motion", &DriftSheet::in_motion, "of the only stretch of one speed or feed"},
               Field{"stability", &DriftSheet::settling,
                     "when each axis is stable, of a record of one speed, or of its only stretch in motion"},
               Field{"courses", &DriftSheet::courses, "trend and steps, where nothing but the drift was logged"});

// A step of the speed.
struct StepRange {
  double from_s = 0.0, to_s = 0.0, speed = 0.0;
  std::string unit;  // of the speed: "rpm"
  TableOf<DriftRange> ranges;
  std::vector<AxisSettling> settling;
};

template <>
inline constexpr auto kResult<StepRange> = ResultType("SpeedStep", "A stretch of one speed.",
                                                      Field{"from_s", &StepRange::from_s},
                                                      Field{"to_s", &StepRange::to_s},
                                                      Field{"speed", with_unit(&StepRange::speed)},
                                                      Field{"ranges", &StepRange::ranges, "by axis"},
                                                      Field{"stability", &StepRange::settling, "by axis"});

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
inline constexpr auto kResult<SeriesRow> = ResultType("SeriesRow", "A row of a series.",
                                                      Field{"time_s", known(&SeriesRow::time_s)},
                                                      Field{"COLUMN", &SeriesRow::values, "a key a column"});
template <>
struct ValueOf<Series> : ValueOf<std::vector<SeriesRow>> {};

template <>
inline constexpr auto kResult<FiveProbeDrift> =
    ResultType("DriftOfProbes", "The drift of the spindle from five probes, or as a log has it.",
               Field{"method", &FiveProbeDrift::method, "five_probe, or log"},
               Field{"reference_s", known(&FiveProbeDrift::reference_s), "time that drift is taken to"},
               Field{"points", &FiveProbeDrift::points, "one row per time, AXIS_um or AXIS_urad with sigma"},
               Field{"steps", &FiveProbeDrift::steps, "changes of the speed"}, fields_of(&FiveProbeDrift::sheet),
               Field{"remarks", &FiveProbeDrift::remarks});

}  // namespace ballbar

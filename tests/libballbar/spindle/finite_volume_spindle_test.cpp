#include "ballbar/lab/spindle/finite_volume_spindle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr double kHour_s = 3600.0;

DutyPlan steady_plan(double speed_rpm, double hours) {
  return {.time_s = {0.0}, .speed_rpm = {speed_rpm}, .end_s = hours * kHour_s};
}

// Two hours on, two hours off, the room 2 K warmer from the first hour to the second.
DutyPlan on_and_off() {
  return {.time_s = {0.0, 2.0 * kHour_s},
          .speed_rpm = {10000.0, 0.0},
          .load_W = {2000.0, 0.0},
          .end_s = 4.0 * kHour_s,
          .room_time_s = {1.0 * kHour_s, 2.0 * kHour_s},
          .room_degC = {20.0, 22.0}};
}

const std::vector<double>& truth(const ThermalRun& run, const char* name) {
  return find_column(run.truth, name)->values;
}
const std::vector<double>& sensor(const ThermalRun& run, const char* name) {
  return find_column(run.sensors, name)->values;
}

double span(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

Mechanisms without(bool Mechanisms::*mechanism) {
  Mechanisms mechanisms;
  mechanisms.*mechanism = false;
  return mechanisms;
}

double imbalance(const HeatBalance& heat) {
  return (heat.source_J - heat.stored_J - heat.room_J - heat.chiller_J) / heat.source_J;
}

// What goes in is stored or goes out, with every mechanism at work and with steps far too long: to rounding.
TEST(FiniteVolumeSpindle, EnergyIsInBalance) {
  EXPECT_LT(std::abs(imbalance(run_of({}, on_and_off()).balance)), 1e-9);
  EXPECT_LT(std::abs(imbalance(run_of({}, on_and_off(), without(&Mechanisms::thermostat), {600.0, 600.0}).balance)),
            1e-9);
}

TEST(FiniteVolumeSpindle, CausesAddUpToThePosition) {
  const ThermalRun run = run_of({}, on_and_off());
  for (std::size_t row = 0; row < run.truth.time_s.size(); ++row) {
    double x_um = 0.0, y_um = 0.0, z_um = 0.0;
    for (std::size_t column = 3; column < run.truth.columns.size(); ++column) {
      const Column& cause = run.truth.columns[column];
      (cause.name[0] == 'x' ? x_um : cause.name[0] == 'y' ? y_um : z_um) += cause.values[row];
    }
    ASSERT_NEAR(truth(run, "x_um")[row], x_um, 1e-12);
    ASSERT_NEAR(truth(run, "y_um")[row], y_um, 1e-12);
    ASSERT_NEAR(truth(run, "z_um")[row], z_um, 1e-12);
  }
}

// In a room that stays, standing, with a steady chiller, it stays where it is.
TEST(FiniteVolumeSpindle, StandsStill) {
  const ThermalRun run = run_of({}, steady_plan(0.0, 5.0), without(&Mechanisms::thermostat));
  for (const char* name : {"x_um", "y_um", "z_um"}) EXPECT_LT(span(truth(run, name)), 1e-6) << name;
}

// Half the cells' length changes z by less than 2 % of its range, at every time.
TEST(FiniteVolumeSpindle, ConvergesWithTheCells) {
  FiniteVolumeSpindle fine;
  fine.cells *= 2.0;
  const Mechanisms steady_chiller = without(&Mechanisms::thermostat);
  const std::vector<double> coarse_um = truth(run_of({}, on_and_off(), steady_chiller), "z_um");
  const std::vector<double> fine_um = truth(run_of(fine, on_and_off(), steady_chiller), "z_um");
  EXPECT_LT(difference(coarse_um, fine_um), 0.02 * span(fine_um));
}

TEST(FiniteVolumeSpindle, ConvergesWithTheStep) {
  const Mechanisms steady_chiller = without(&Mechanisms::thermostat);
  const std::vector<double> coarse_um = truth(run_of({}, on_and_off(), steady_chiller, {15.0, 15.0}), "z_um");
  const std::vector<double> fine_um = truth(run_of({}, on_and_off(), steady_chiller, {15.0, 1.0}), "z_um");
  EXPECT_LT(difference(coarse_um, fine_um), 0.02 * span(fine_um));
}

// 60 h are 24 time constants of the column. The steady state has no error of time.
TEST(FiniteVolumeSpindle, SteadyStateDoesNotDependOnTheStep) {
  const Mechanisms steady_chiller = without(&Mechanisms::thermostat);
  const double short_um = truth(run_of({}, steady_plan(10000.0, 60.0), steady_chiller, {600.0, 60.0}), "z_um").back();
  const double long_um = truth(run_of({}, steady_plan(10000.0, 60.0), steady_chiller, {600.0, 600.0}), "z_um").back();
  EXPECT_NEAR(short_um, long_um, 1e-5);
}

// Cells of 10 mm have time constants of seconds. With 10 min a step nothing swings: the front warms and never cools.
TEST(FiniteVolumeSpindle, LongStepsAreStable) {
  const ThermalRun run = run_of({}, steady_plan(20000.0, 24.0), without(&Mechanisms::thermostat), {600.0, 600.0});
  const std::vector<double>& front_degC = sensor(run, "T_front_degC");
  for (std::size_t row = 1; row < front_degC.size(); ++row) EXPECT_GT(front_degC[row], front_degC[row - 1] - 1e-6);
  EXPECT_LT(front_degC.back(), 100.0);
}

// Steps end where the speed changes: a change between two rows is not moved to one of them.
TEST(FiniteVolumeSpindle, SpeedMayChangeBetweenRows) {
  DutyPlan plan{.time_s = {0.0, 1000.0}, .speed_rpm = {10000.0, 0.0}, .end_s = 1800.0};
  const Mechanisms steady_chiller = without(&Mechanisms::thermostat);
  const double seldom_um = truth(run_of({}, plan, steady_chiller, {1800.0, 5.0}), "z_um").back();
  const double often_um = truth(run_of({}, plan, steady_chiller, {5.0, 5.0}), "z_um").back();
  EXPECT_NEAR(seldom_um, often_um, 1e-9);
}

// What the header promises: tens of um along the axis at 10 000 rpm, most of it in a quarter of an hour, the column in
// hours.
TEST(FiniteVolumeSpindle, MovesAsSpindlesDo) {
  const ThermalRun run = run_of({}, steady_plan(10000.0, 8.0), without(&Mechanisms::thermostat));
  const auto at_min = [&](const char* name, std::size_t min) { return truth(run, name)[4 * min]; };
  EXPECT_NEAR(at_min("z_shaft_um", 480), 36.0, 4.0);
  EXPECT_NEAR(at_min("z_shaft_um", 9) / at_min("z_shaft_um", 480), 0.6, 0.1);
  EXPECT_NEAR(at_min("z_structure_um", 480), -6.5, 1.5);
  EXPECT_NEAR(at_min("z_structure_um", 120) / at_min("z_structure_um", 480), 0.63, 0.1);
  EXPECT_NEAR(at_min("y_um", 480), 6.6, 1.5);
  EXPECT_NEAR(at_min("x_um", 480), -2.7, 0.6);
}

TEST(FiniteVolumeSpindle, SpeedMovesItAtOnce) {
  const ThermalRun run = run_of({}, on_and_off());
  EXPECT_LT(truth(run, "z_centrifugal_um").front(), -1.0);
  EXPECT_EQ(truth(run, "z_um").front(), truth(run, "z_centrifugal_um").front());
  EXPECT_EQ(truth(run, "z_centrifugal_um").back(), 0.0);
  EXPECT_EQ(span(truth(run_of({}, on_and_off(), without(&Mechanisms::centrifugal)), "z_centrifugal_um")), 0.0);
}

TEST(FiniteVolumeSpindle, SidesThatShareAlikeDoNotBend) {
  const ThermalRun run = run_of({}, on_and_off(), without(&Mechanisms::asymmetry));
  EXPECT_LT(span(truth(run, "x_um")), 1e-9);
  EXPECT_LT(span(truth(run, "y_bending_um")), 1e-9);
  EXPECT_GT(span(truth(run, "z_um")), 20.0);
}

TEST(FiniteVolumeSpindle, RoomThatIsOffDoesNothingButIsMeasured) {
  DutyPlan plan = steady_plan(0.0, 4.0);
  plan.room_time_s = {0.0, kHour_s};
  plan.room_degC = {20.0, 23.0};
  const Mechanisms steady_chiller = without(&Mechanisms::thermostat);
  Mechanisms off = steady_chiller;
  off.room = false;
  // 500 mm of column grow 5.25 um/K in hours; the spindle is held by its coolant.
  EXPECT_GT(span(truth(run_of({}, plan, steady_chiller), "z_um")), 5.0);
  EXPECT_LT(span(truth(run_of({}, plan, off), "z_um")), 1e-6);
  EXPECT_EQ(sensor(run_of({}, plan, off), "T_room_degC").back(), 23.0);
}

// The tank goes from the upper to the lower threshold, and a step beyond: 3000 W in 60 kg of water are 0.18 K in 15 s.
TEST(FiniteVolumeSpindle, ThermostatCycles) {
  const std::vector<double> cycling_degC = sensor(run_of({}, steady_plan(10000.0, 4.0)), "T_coolant_degC");
  EXPECT_NEAR(*std::max_element(cycling_degC.begin(), cycling_degC.end()), 20.5, 0.1);
  EXPECT_NEAR(*std::min_element(cycling_degC.begin(), cycling_degC.end()), 19.5, 0.2);
  const ThermalRun steady = run_of({}, steady_plan(10000.0, 4.0), without(&Mechanisms::thermostat));
  EXPECT_LT(span(sensor(steady, "T_coolant_degC")), 0.5);
}

TEST(FiniteVolumeSpindle, DryJacketIsHotter) {
  const auto motor_degC = [](const Mechanisms& mechanisms) {
    return sensor(run_of({}, steady_plan(10000.0, 4.0), mechanisms), "T_motor_degC").back();
  };
  EXPECT_GT(motor_degC(without(&Mechanisms::coolant)), motor_degC({}) + 10.0);
}

// Cold oil at first, warm oil later: more heat in the first minutes than by the viscosity of 40 degC, from a front
// bearing that ends near 40 degC or above.
TEST(FiniteVolumeSpindle, ColdOilHeatsMore) {
  const auto source_J = [](const Mechanisms& mechanisms) {
    return run_of({}, steady_plan(10000.0, 0.05), mechanisms).balance.source_J;
  };
  EXPECT_GT(source_J({}), 1.1 * source_J(without(&Mechanisms::viscosity)));
}

TEST(FiniteVolumeSpindle, AirOfAStandingSpindleCoolsLess) {
  const auto front_degC = [](const Mechanisms& mechanisms) {
    return sensor(run_of({}, steady_plan(10000.0, 4.0), mechanisms), "T_front_degC").back();
  };
  EXPECT_GT(front_degC(without(&Mechanisms::convection)), front_degC({}) + 1.0);
}

TEST(FiniteVolumeSpindle, RingsAndStructureCanBeLeftOut) {
  EXPECT_EQ(span(truth(run_of({}, on_and_off(), without(&Mechanisms::rings)), "z_rings_um")), 0.0);
  const ThermalRun rigid = run_of({}, on_and_off(), without(&Mechanisms::structure));
  EXPECT_EQ(span(truth(rigid, "z_structure_um")), 0.0);
  EXPECT_EQ(span(truth(rigid, "y_structure_um")), 0.0);
}

TEST(FiniteVolumeSpindle, LoadWarmsTheMotor) {
  DutyPlan loaded = steady_plan(10000.0, 1.0);
  loaded.load_W = {5000.0};
  EXPECT_GT(sensor(run_of({}, loaded), "T_motor_degC").back(),
            sensor(run_of({}, steady_plan(10000.0, 1.0)), "T_motor_degC").back() + 2.0);
}

// The tank's water stays within the hysteresis, 1 K, about the set point.
TEST(FiniteVolumeSpindle, CoolantFollowsItsSetPoint) {
  const DutyPlan plan = steady_plan(10000.0, 3.0);
  EXPECT_NEAR(sensor(run_of({}, plan), "T_coolant_degC").back(), 20.0, 0.7);
  FiniteVolumeSpindle warmer;
  warmer.set_point_degC = 23.0;
  EXPECT_NEAR(sensor(run_of(warmer, plan), "T_coolant_degC").back(), 23.0, 0.7);
}

TEST(FiniteVolumeSpindle, RowsAndRoles) {
  const ThermalRun run = run_of({}, steady_plan(8000.0, 0.01), {}, {10.0, 5.0});
  EXPECT_EQ(run.sensors.time_s, (std::vector<double>{0.0, 10.0, 20.0, 30.0}));  // 36 s
  EXPECT_EQ(run.truth.time_s, run.sensors.time_s);
  std::string columns;
  for (const Column& column : run.sensors.columns)
    columns += column.name + ":" + std::string(name_of(column.role)) + " ";
  EXPECT_EQ(columns,
            "speed_rpm:speed load_W:load T_front_degC:bearing T_rear_degC:bearing T_motor_degC:structure "
            "T_housing_degC:housing T_coolant_degC:coolant T_head_degC:structure T_column_degC:structure "
            "T_room_degC:ambient ");
}

// 120 min and 240 min are rows. z_shaft sums alpha dT dx from the middle of the front bearing, 335 mm, which halves the
// cell from 330 to 340 mm, to the ball at 520 mm.
TEST(FiniteVolumeSpindle, ProfilesAddUpToTheElongationOfTheShaft) {
  const ThermalRun run = run_of({}, on_and_off(), {}, {15.0, 15.0, {0.0, 2.0 * kHour_s, 4.0 * kHour_s}});
  ASSERT_EQ(run.profiles.size(), 3u);
  const TemperatureProfile& start = run.profiles[0].shaft;
  ASSERT_EQ(start.x_mm.size(), 52u);
  EXPECT_EQ(start.x_mm.front(), 5.0);
  EXPECT_EQ(start.x_mm.back(), 515.0);
  for (const ShaftProfile& profile : run.profiles) {
    double elongation_um = 0.0;
    for (std::size_t i = 0; i < 52; ++i) {
      const double length_mm = start.x_mm[i] < 335.0 ? 0.0 : start.x_mm[i] == 335.0 ? 5.0 : 10.0;
      elongation_um += 11.7e-3 * length_mm * (profile.shaft.degC[i] - start.degC[i]);
    }
    const auto row = static_cast<std::size_t>(profile.time_s / 15.0);
    EXPECT_NEAR(elongation_um, truth(run, "z_shaft_um")[row], 1e-9) << profile.time_s;
  }
  EXPECT_GT(truth(run, "z_shaft_um")[480], 20.0);
}

// What is asked for between two rows is the state there: that of a run with a row at that time. On a row it changes
// nothing.
TEST(FiniteVolumeSpindle, ProfilesBetweenRows) {
  const DutyPlan plan = steady_plan(10000.0, 0.5);
  const ThermalRun seldom = run_of({}, plan, {}, {60.0, 5.0, {90.0, 100.0, 600.0}});
  const ThermalRun often = run_of({}, plan, {}, {5.0, 5.0, {90.0, 100.0, 600.0}});
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_LT(difference(seldom.profiles[k].shaft.degC, often.profiles[k].shaft.degC), 1e-9);
  EXPECT_EQ(seldom.profiles[1].time_s, 100.0);
  EXPECT_EQ(truth(run_of({}, plan, {}, {60.0, 60.0, {600.0}}), "z_um"),
            truth(run_of({}, plan, {}, {60.0, 60.0}), "z_um"));
  EXPECT_TRUE(run_of({}, plan).profiles.empty());
}

std::string complaint(const FiniteVolumeSpindle& spindle, const DutyPlan& plan, const ThermalClock& clock = {}) {
  try {
    run_of(spindle, plan, {}, clock);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(FiniteVolumeSpindle, RefusesWhatMakesNoSense) {
  const auto spindle = [](double FiniteVolumeSpindle::*member, double value) {
    FiniteVolumeSpindle changed;
    changed.*member = value;
    return complaint(changed, on_and_off());
  };
  using S = FiniteVolumeSpindle;
  EXPECT_EQ(spindle(&S::head_kg, -3.0), "spindle: expected a number above 0 for head_kg, found -3.");
  EXPECT_EQ(spindle(&S::f0, -1.0), "spindle: expected a number not below 0 for f0, found -1.");
  EXPECT_EQ(spindle(&S::pump_W, NAN), "spindle: expected a finite number for pump_W, found nan.");
  EXPECT_EQ(spindle(&S::flow_W_per_K, 1e300), "spindle: expected a number up to 1e+09 for flow_W_per_K, found 1e+300.");
  EXPECT_EQ(spindle(&S::cells, 10.5), "spindle: expected a whole number from 1 to 1000 for cells, found 10.5.");
  EXPECT_EQ(spindle(&S::front_to_mm, 400.0), "spindle: expected front_to_mm not above housing_mm, found 400 and 380.");
  EXPECT_EQ(spindle(&S::rear_to_mm, 30.0), "spindle: expected rear_to_mm above rear_from_mm, found 30 and 40.");
  EXPECT_EQ(spindle(&S::bore_radius_mm, 40.0),
            "spindle: expected shaft_radius_mm above bore_radius_mm, found 32 and 40.");
  EXPECT_EQ(spindle(&S::coolant_to_plus_x, 1.5),
            "spindle: expected a number from -1 to 1 for coolant_to_plus_x, found 1.5.");
}

// lg lg (0.2 + 0.7) is not a number.
TEST(FiniteVolumeSpindle, RefusesAnOilThatIsNone) {
  FiniteVolumeSpindle thin;
  thin.oil_at_100_degC_mm2_per_s = 0.2;
  EXPECT_EQ(complaint(thin, on_and_off()),
            "spindle: expected finite temperatures of these masses, conductances, oil and speeds, found others.");
}

TEST(FiniteVolumeSpindle, RefusesPlansThatMakeNoSense) {
  EXPECT_EQ(complaint({}, {}), "spindle: expected a duty plan of at least one speed, found none.");
  DutyPlan plan = on_and_off();
  plan.time_s = {0.0, 0.0};
  EXPECT_EQ(complaint({}, plan), "spindle: expected rising times for the duty plan, found 0 s after 0 s.");
  plan = on_and_off();
  plan.speed_rpm = {1.0};
  EXPECT_EQ(complaint({}, plan), "spindle: expected as many values for speed_rpm as times, 2, found 1.");
  plan = on_and_off();
  plan.speed_rpm = {1.0, -5.0};
  EXPECT_EQ(complaint({}, plan), "spindle: expected a number not below 0 for speed_rpm, found -5.");
  plan = on_and_off();
  plan.end_s = 100.0;
  EXPECT_EQ(complaint({}, plan),
            "spindle: expected a duty plan that ends at its last step or later, found 100 s before 7200 s.");
  plan = on_and_off();
  plan.room_degC = {20.0, 400.0};
  EXPECT_EQ(complaint({}, plan), "spindle: expected a room from -50 to 100 degC, found 400.");
  EXPECT_EQ(complaint({}, on_and_off(), {0.0, 15.0}), "spindle: expected a number above 0 for interval_s, found 0.");
  EXPECT_EQ(complaint({}, on_and_off(), {0.001, 15.0}),
            "spindle: expected at most 1000000 rows, found 14400000; widen interval_s.");
  EXPECT_EQ(complaint({}, on_and_off(), {15.0, 15.0, {60.0, 60.0}}),
            "spindle: expected rising times for the profiles, found 60 s after 60 s.");
  // Rows every 700 s: the last is the 20th.
  EXPECT_EQ(complaint({}, on_and_off(), {700.0, 15.0, {60.0, 14200.0}}),
            "spindle: expected times of profiles from the start, 0 s, to the last row, 14000 s, found 14200 s.");
}

}  // namespace
}  // namespace ballbar

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string_view>

#include "ballbar/error.hpp"
#include "spindle/spindle_cells.hpp"

namespace ballbar {
namespace {

using S = FiniteVolumeSpindle;

constexpr std::array kParameters = {
    SpindleParameter{"cells", &S::cells, Bound::positive},
    SpindleParameter{"length_mm", &S::length_mm, Bound::positive},
    SpindleParameter{"nose_mm", &S::nose_mm, Bound::positive},
    SpindleParameter{"housing_mm", &S::housing_mm, Bound::positive},
    SpindleParameter{"flange_mm", &S::flange_mm, Bound::positive},
    SpindleParameter{"flange_width_mm", &S::flange_width_mm, Bound::positive},
    SpindleParameter{"rear_from_mm", &S::rear_from_mm, Bound::not_negative},
    SpindleParameter{"rear_to_mm", &S::rear_to_mm, Bound::positive},
    SpindleParameter{"motor_from_mm", &S::motor_from_mm, Bound::not_negative},
    SpindleParameter{"motor_to_mm", &S::motor_to_mm, Bound::positive},
    SpindleParameter{"front_from_mm", &S::front_from_mm, Bound::not_negative},
    SpindleParameter{"front_to_mm", &S::front_to_mm, Bound::positive},
    SpindleParameter{"jacket_from_mm", &S::jacket_from_mm, Bound::not_negative},
    SpindleParameter{"jacket_to_mm", &S::jacket_to_mm, Bound::positive},
    SpindleParameter{"bore_radius_mm", &S::bore_radius_mm, Bound::not_negative},
    SpindleParameter{"shaft_radius_mm", &S::shaft_radius_mm, Bound::positive},
    SpindleParameter{"tool_radius_mm", &S::tool_radius_mm, Bound::positive},
    SpindleParameter{"housing_inner_mm", &S::housing_inner_mm, Bound::positive},
    SpindleParameter{"housing_outer_mm", &S::housing_outer_mm, Bound::positive},
    SpindleParameter{"density_kg_per_m3", &S::density_kg_per_m3, Bound::positive},
    SpindleParameter{"specific_heat_J_per_kg_K", &S::specific_heat_J_per_kg_K, Bound::positive},
    SpindleParameter{"conductivity_W_per_m_K", &S::conductivity_W_per_m_K, Bound::positive},
    SpindleParameter{"expansion_ppm_per_K", &S::expansion_ppm_per_K, Bound::any},
    SpindleParameter{"young_GPa", &S::young_GPa, Bound::positive},
    SpindleParameter{"poisson", &S::poisson, Bound::not_negative},
    SpindleParameter{"front_rows", &S::front_rows, Bound::positive},
    SpindleParameter{"rear_rows", &S::rear_rows, Bound::positive},
    SpindleParameter{"front_pitch_mm", &S::front_pitch_mm, Bound::positive},
    SpindleParameter{"rear_pitch_mm", &S::rear_pitch_mm, Bound::positive},
    SpindleParameter{"ball_mm", &S::ball_mm, Bound::positive},
    SpindleParameter{"balls", &S::balls, Bound::positive},
    SpindleParameter{"ball_density_kg_per_m3", &S::ball_density_kg_per_m3, Bound::not_negative},
    SpindleParameter{"groove", &S::groove, Bound::positive},
    SpindleParameter{"contact_angle_deg", &S::contact_angle_deg, Bound::positive},
    SpindleParameter{"f0", &S::f0, Bound::not_negative},
    SpindleParameter{"f1", &S::f1, Bound::not_negative},
    SpindleParameter{"bearing_load_N", &S::bearing_load_N, Bound::positive},
    SpindleParameter{"bearing_mass_kg", &S::bearing_mass_kg, Bound::positive},
    SpindleParameter{"inner_ring_W_per_K", &S::inner_ring_W_per_K, Bound::positive},
    SpindleParameter{"outer_ring_W_per_K", &S::outer_ring_W_per_K, Bound::positive},
    SpindleParameter{"oil_at_40_degC_mm2_per_s", &S::oil_at_40_degC_mm2_per_s, Bound::positive},
    SpindleParameter{"oil_at_100_degC_mm2_per_s", &S::oil_at_100_degC_mm2_per_s, Bound::positive},
    SpindleParameter{"motor_loss_W", &S::motor_loss_W, Bound::not_negative},
    SpindleParameter{"motor_windage_W", &S::motor_windage_W, Bound::not_negative},
    SpindleParameter{"load_loss_share", &S::load_loss_share, Bound::not_negative},
    SpindleParameter{"rotor_share", &S::rotor_share, Bound::not_negative},
    SpindleParameter{"shaft_still_W_per_m2_K", &S::shaft_still_W_per_m2_K, Bound::not_negative},
    SpindleParameter{"shaft_turning_W_per_m2_K", &S::shaft_turning_W_per_m2_K, Bound::not_negative},
    SpindleParameter{"gap_still_W_per_m2_K", &S::gap_still_W_per_m2_K, Bound::not_negative},
    SpindleParameter{"gap_turning_W_per_m2_K", &S::gap_turning_W_per_m2_K, Bound::not_negative},
    SpindleParameter{"housing_still_W_per_m2_K", &S::housing_still_W_per_m2_K, Bound::not_negative},
    SpindleParameter{"housing_turning_W_per_m2_K", &S::housing_turning_W_per_m2_K, Bound::not_negative},
    SpindleParameter{"jacket_W_per_K", &S::jacket_W_per_K, Bound::not_negative},
    SpindleParameter{"jacket_water_kg", &S::jacket_water_kg, Bound::positive},
    SpindleParameter{"flow_W_per_K", &S::flow_W_per_K, Bound::positive},
    SpindleParameter{"tank_kg", &S::tank_kg, Bound::positive},
    SpindleParameter{"tank_room_W_per_K", &S::tank_room_W_per_K, Bound::positive},
    SpindleParameter{"pump_W", &S::pump_W, Bound::not_negative},
    SpindleParameter{"chiller_W", &S::chiller_W, Bound::not_negative},
    SpindleParameter{"set_point_degC", &S::set_point_degC, Bound::any},
    SpindleParameter{"hysteresis_K", &S::hysteresis_K, Bound::not_negative},
    SpindleParameter{"chiller_W_per_K", &S::chiller_W_per_K, Bound::not_negative},
    SpindleParameter{"stator_to_plus_x", &S::stator_to_plus_x, Bound::any},
    SpindleParameter{"coolant_to_plus_x", &S::coolant_to_plus_x, Bound::any},
    SpindleParameter{"flange_to_minus_y", &S::flange_to_minus_y, Bound::any},
    SpindleParameter{"flange_W_per_K", &S::flange_W_per_K, Bound::not_negative},
    SpindleParameter{"head_kg", &S::head_kg, Bound::positive},
    SpindleParameter{"column_kg", &S::column_kg, Bound::positive},
    SpindleParameter{"structure_heat_J_per_kg_K", &S::structure_heat_J_per_kg_K, Bound::positive},
    SpindleParameter{"structure_expansion_ppm_per_K", &S::structure_expansion_ppm_per_K, Bound::any},
    SpindleParameter{"head_column_W_per_K", &S::head_column_W_per_K, Bound::not_negative},
    SpindleParameter{"column_front_back_W_per_K", &S::column_front_back_W_per_K, Bound::not_negative},
    SpindleParameter{"head_room_W_per_K", &S::head_room_W_per_K, Bound::positive},
    SpindleParameter{"column_room_W_per_K", &S::column_room_W_per_K, Bound::positive},
    SpindleParameter{"overhang_mm", &S::overhang_mm, Bound::not_negative},
    SpindleParameter{"column_height_mm", &S::column_height_mm, Bound::not_negative},
    SpindleParameter{"column_depth_mm", &S::column_depth_mm, Bound::positive},
};
static_assert(sizeof(S) == kParameters.size() * sizeof(double), "every number of the spindle has its line above");

constexpr std::array kMechanisms = {
    Mechanism{"viscosity", &Mechanisms::viscosity},     Mechanism{"convection", &Mechanisms::convection},
    Mechanism{"asymmetry", &Mechanisms::asymmetry},     Mechanism{"rings", &Mechanisms::rings},
    Mechanism{"centrifugal", &Mechanisms::centrifugal}, Mechanism{"thermostat", &Mechanisms::thermostat},
    Mechanism{"coolant", &Mechanisms::coolant},         Mechanism{"room", &Mechanisms::room},
    Mechanism{"structure", &Mechanisms::structure},
};
static_assert(sizeof(Mechanisms) == kMechanisms.size() * sizeof(bool));

[[noreturn]] void refuse(std::string_view sentence) { throw Error(fmt::format("spindle: {}", sentence)); }

void expect_finite(std::string_view name, double value) {
  if (!std::isfinite(value)) refuse(fmt::format("expected a finite number for {}, found {}.", name, value));
}

void expect_bound(const SpindleParameter& parameter, double value) {
  constexpr double kMost = 1e9;  // far beyond any machine, far below where sums overflow
  expect_finite(parameter.name, value);
  if (std::abs(value) > kMost) {
    refuse(fmt::format("expected a number up to {:g} for {}, found {}.", kMost, parameter.name, value));
  }
  if (parameter.bound == Bound::positive && !(value > 0.0)) {
    refuse(fmt::format("expected a number above 0 for {}, found {}.", parameter.name, value));
  }
  if (parameter.bound == Bound::not_negative && value < 0.0) {
    refuse(fmt::format("expected a number not below 0 for {}, found {}.", parameter.name, value));
  }
}

struct Named {
  std::string_view name;
  double value;
};

void expect_above(const Named& lesser, const Named& greater) {
  if (greater.value > lesser.value) return;
  refuse(fmt::format("expected {} above {}, found {} and {}.", greater.name, lesser.name, greater.value, lesser.value));
}

void expect_not_above(const Named& value, const Named& limit) {
  if (value.value <= limit.value) return;
  refuse(fmt::format("expected {} not above {}, found {} and {}.", value.name, limit.name, value.value, limit.value));
}

void check_lengths(const S& s) {
  expect_above({"rear_from_mm", s.rear_from_mm}, {"rear_to_mm", s.rear_to_mm});
  expect_above({"motor_from_mm", s.motor_from_mm}, {"motor_to_mm", s.motor_to_mm});
  expect_above({"front_from_mm", s.front_from_mm}, {"front_to_mm", s.front_to_mm});
  expect_above({"jacket_from_mm", s.jacket_from_mm}, {"jacket_to_mm", s.jacket_to_mm});
  expect_not_above({"rear_to_mm", s.rear_to_mm}, {"front_from_mm", s.front_from_mm});
  const Named housing{"housing_mm", s.housing_mm};
  expect_not_above({"motor_to_mm", s.motor_to_mm}, housing);
  expect_not_above({"front_to_mm", s.front_to_mm}, housing);
  expect_not_above({"jacket_to_mm", s.jacket_to_mm}, housing);
  expect_not_above({"flange_mm + flange_width_mm / 2", s.flange_mm + s.flange_width_mm / 2.0}, housing);
  expect_not_above({"flange_width_mm / 2", s.flange_width_mm / 2.0}, {"flange_mm", s.flange_mm});
  expect_not_above(housing, {"nose_mm", s.nose_mm});
  expect_not_above({"nose_mm", s.nose_mm}, {"length_mm", s.length_mm});
  expect_above({"bore_radius_mm", s.bore_radius_mm}, {"shaft_radius_mm", s.shaft_radius_mm});
  expect_not_above({"shaft_radius_mm", s.shaft_radius_mm}, {"housing_inner_mm", s.housing_inner_mm});
  expect_above({"housing_inner_mm", s.housing_inner_mm}, {"housing_outer_mm", s.housing_outer_mm});
  expect_above({"ball_mm", s.ball_mm}, {"front_pitch_mm", s.front_pitch_mm});
}

void expect_rising(std::string_view what, const std::vector<double>& time_s) {
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    expect_finite(fmt::format("a time of {}", what), time_s[i]);
    if (i == 0 || time_s[i] > time_s[i - 1]) continue;
    refuse(fmt::format("expected rising times for {}, found {} s after {} s.", what, time_s[i], time_s[i - 1]));
  }
}

void expect_as_many(std::string_view what, std::size_t values, std::size_t times) {
  if (values == times) return;
  refuse(fmt::format("expected as many values for {} as times, {}, found {}.", what, times, values));
}

void expect_not_negative(std::string_view what, const std::vector<double>& values) {
  for (const double value : values) expect_bound({what, nullptr, Bound::not_negative}, value);
}

void check_profiles(const DutyPlan& plan, const ThermalClock& clock) {
  constexpr std::size_t kMostProfiles = 10000;
  if (clock.profile_s.empty()) return;
  if (clock.profile_s.size() > kMostProfiles) {
    refuse(fmt::format("expected at most {} profiles, found {}.", kMostProfiles, clock.profile_s.size()));
  }
  expect_rising("the profiles", clock.profile_s);
  const double start_s = plan.time_s.front();
  const double last_s = start_s + static_cast<double>(thermal::intervals_of(plan, clock)) * clock.interval_s;
  for (const double profile_s : clock.profile_s) {
    if (profile_s >= start_s && profile_s <= last_s) continue;
    refuse(fmt::format("expected times of profiles from the start, {} s, to the last row, {} s, found {} s.", start_s,
                       last_s, profile_s));
  }
}

}  // namespace

std::span<const SpindleParameter> spindle_parameters() { return kParameters; }
std::span<const Mechanism> mechanisms() { return kMechanisms; }

namespace thermal {

void check(const FiniteVolumeSpindle& spindle) {
  constexpr double kMostCells = 1000.0;
  for (const SpindleParameter& parameter : kParameters) expect_bound(parameter, spindle.*parameter.member);
  if (spindle.cells != std::floor(spindle.cells) || spindle.cells > kMostCells) {
    refuse(fmt::format("expected a whole number from 1 to {} for cells, found {}.", kMostCells, spindle.cells));
  }
  check_lengths(spindle);
  expect_not_above({"rotor_share", spindle.rotor_share}, {"1", 1.0});
  expect_not_above({"poisson", spindle.poisson}, {"0.5", 0.5});
  expect_above({"contact_angle_deg", spindle.contact_angle_deg}, {"90", 90.0});
  expect_above({"0.5", 0.5}, {"groove", spindle.groove});
  expect_above({"oil_at_100_degC_mm2_per_s", spindle.oil_at_100_degC_mm2_per_s},
               {"oil_at_40_degC_mm2_per_s", spindle.oil_at_40_degC_mm2_per_s});
  for (const Named& excess :
       {Named{"stator_to_plus_x", spindle.stator_to_plus_x}, Named{"coolant_to_plus_x", spindle.coolant_to_plus_x},
        Named{"flange_to_minus_y", spindle.flange_to_minus_y}}) {
    if (std::abs(excess.value) <= 1.0) continue;
    refuse(fmt::format("expected a number from -1 to 1 for {}, found {}.", excess.name, excess.value));
  }
}

void check(const DutyPlan& plan, const ThermalClock& clock) {
  constexpr double kMostRows = 1e6;
  constexpr double kMostSteps = 1e7;
  if (plan.time_s.empty()) refuse("expected a duty plan of at least one speed, found none.");
  expect_rising("the duty plan", plan.time_s);
  expect_as_many("speed_rpm", plan.speed_rpm.size(), plan.time_s.size());
  expect_not_negative("speed_rpm", plan.speed_rpm);
  if (!plan.load_W.empty()) expect_as_many("load_W", plan.load_W.size(), plan.time_s.size());
  expect_not_negative("load_W", plan.load_W);
  expect_rising("the room", plan.room_time_s);
  expect_as_many("the room", plan.room_degC.size(), plan.room_time_s.size());
  for (const double room_degC : plan.room_degC) {
    expect_finite("the room", room_degC);
    if (room_degC < -50.0 || room_degC > 100.0) {
      refuse(fmt::format("expected a room from -50 to 100 degC, found {}.", room_degC));
    }
  }
  expect_finite("the end of the duty plan", plan.end_s);
  if (plan.end_s < plan.time_s.back()) {
    refuse(fmt::format("expected a duty plan that ends at its last step or later, found {} s before {} s.", plan.end_s,
                       plan.time_s.back()));
  }
  expect_bound({"interval_s", nullptr, Bound::positive}, clock.interval_s);
  expect_bound({"step_s", nullptr, Bound::positive}, clock.step_s);
  const double span_s = plan.end_s - plan.time_s.front();
  if (span_s / clock.interval_s > kMostRows) {
    refuse(fmt::format("expected at most {:.0f} rows, found {:.0f}; widen interval_s.", kMostRows,
                       span_s / clock.interval_s));
  }
  if (span_s / clock.step_s > kMostSteps) {
    refuse(
        fmt::format("expected at most {:.0f} steps, found {:.0f}; widen step_s.", kMostSteps, span_s / clock.step_s));
  }
  check_profiles(plan, clock);
}

}  // namespace thermal
}  // namespace ballbar

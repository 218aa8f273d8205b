#include "spindle_set.hpp"

#include <initializer_list>

#include "ballbar/challenge/blind.hpp"
#include "ballbar/simulation/virtual_spindle.hpp"

namespace ballbar::study {
namespace {

BoundEffect bound(const char* effect, std::vector<std::string> columns = {}) {
  return {find_effect(effect, Level::series), std::move(columns)};
}

void add_expansions(std::vector<BoundEffect>& bounds, std::initializer_list<const char*> columns) {
  for (const char* column : columns) {
    bounds.push_back(bound("expansion", {column}));
    bounds.push_back(bound("lagged_expansion", {column}));
  }
}

DutyPlan duty_of_the_record() {
  const Series record = rich_record().inputs;
  DutyPlan plan;
  const std::vector<double>& speed = find_column(record, "speed_rpm")->values;
  for (std::size_t i = 0; i < speed.size(); ++i) {
    if (i > 0 && speed[i] == speed[i - 1]) continue;
    plan.time_s.push_back(record.time_s[i]);
    plan.speed_rpm.push_back(4.0 * speed[i]);
  }
  plan.end_s = record.time_s.back();
  plan.room_time_s = record.time_s;
  plan.room_degC = find_column(record, "T_room_degC")->values;
  return plan;
}

}  // namespace

DataSet spindle_cause(std::uint64_t seed) {
  BlindSet blind = blind_set(BlindKind::spindle, seed);
  DataSet set;
  set.data = std::move(blind.data);
  set.model = std::move(blind.model);
  set.hidden.push_back({std::nullopt, blind.answer.what, blind.hidden_um.front(), blind.answer.match});
  set.options.search.seed = seed;
  return set;
}

DataSet whole_spindle(std::uint64_t seed) {
  DataSet set;
  set.options.search.seed = seed;
  set.model.targets = {"z_um"};
  set.model.terms = {term_of("speed_heating", {"speed_rpm"})};
  add_expansions(set.also_true, {"T_front_degC", "T_rear_degC", "T_motor_degC", "T_housing_degC", "T_coolant_degC"});
  set.also_true.push_back(bound("cooling_asymmetry"));
  set.also_true.push_back(bound("viscosity_feedback"));

  Mechanisms on;
  on.thermostat = on.centrifugal = on.rings = on.structure = on.room = false;
  Hidden hidden;
  switch (seed % 4) {
    case 1:
      on.centrifugal = true;
      hidden = {std::nullopt, "centrifugal", {}, {bound("centrifugal_shift")}};
      break;
    case 2:
      on.rings = true;
      hidden = {std::nullopt, "rings", {}, {bound("bearing_rings")}};
      add_expansions(hidden.match, {"T_front_degC", "T_rear_degC"});
      break;
    case 3:
      on.structure = on.room = true;
      hidden = {std::nullopt, "structure", {}, {}};
      add_expansions(hidden.match, {"T_head_degC", "T_column_degC", "T_room_degC"});
      for (const char* hot : {"T_head_degC", "T_column_degC", "T_room_degC"}) {
        for (const char* cold : {"T_head_degC", "T_column_degC", "T_room_degC"}) {
          if (hot != cold) hidden.match.push_back(bound("gradient_bending", {hot, cold}));
        }
      }
      break;
    default:
      break;
  }
  if (!hidden.what.empty()) set.hidden.push_back(std::move(hidden));

  SpindleMeasurement measurement;
  measurement.memory_um = 0.3;
  measurement.memory_s = 720.0;
  const ThermalRun run = run_of(varied({}, 0.2, seed), duty_of_the_record(), on, {75.0, 30.0});
  set.data = measured_series(run, measurement, seed);
  std::erase_if(set.data.columns, [](const Column& column) {
    return column.role == Role::load || (column.role == Role::measured && column.name != "z_um");
  });
  return set;
}

}  // namespace ballbar::study

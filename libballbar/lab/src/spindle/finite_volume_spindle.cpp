#include "ballbar/lab/spindle/finite_volume_spindle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "ballbar/error.hpp"
#include "spindle/spindle_network.hpp"
#include "spindle/spindle_tip.hpp"

namespace ballbar {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

double room_degC(const DutyPlan& plan, double at_s) {
  if (plan.room_time_s.empty()) return 20.0;
  const auto after = std::upper_bound(plan.room_time_s.begin(), plan.room_time_s.end(), at_s);
  if (after == plan.room_time_s.begin()) return plan.room_degC.front();
  if (after == plan.room_time_s.end()) return plan.room_degC.back();
  const auto i = static_cast<std::size_t>(after - plan.room_time_s.begin());
  const double share = (at_s - plan.room_time_s[i - 1]) / (plan.room_time_s[i] - plan.room_time_s[i - 1]);
  return plan.room_degC[i - 1] + share * (plan.room_degC[i] - plan.room_degC[i - 1]);
}

struct Duty {
  double speed_rpm = 0.0;
  double load_W = 0.0;
};

Duty duty_at(const DutyPlan& plan, double at_s) {
  const auto after = std::upper_bound(plan.time_s.begin(), plan.time_s.end(), at_s);
  const auto i = static_cast<std::size_t>(after - plan.time_s.begin()) - 1;
  return {plan.speed_rpm[i], plan.load_W.empty() ? 0.0 : plan.load_W[i]};
}

struct Sensor {
  const char* name;
  Role role;
  VectorXd weights;  // of the nodes, sum 1
};

VectorXd one_node(const thermal::Cells& cells, Index node) { return VectorXd::Unit(cells.nodes(), node); }

VectorXd mean_of_housing(const thermal::Cells& cells, const thermal::Interval& along, thermal::Side side) {
  VectorXd weights = VectorXd::Zero(cells.nodes());
  for (std::size_t j = 0; j < cells.housing.size(); ++j) {
    weights[cells.housing_node(j, side)] = thermal::overlap_mm(cells.housing[j], along);
  }
  return weights / weights.sum();
}

std::vector<Sensor> sensors_of(const FiniteVolumeSpindle& spindle, const thermal::Cells& cells) {
  constexpr double kFrontEnd_mm = 20.0;
  const thermal::Interval front_end{std::max(0.0, spindle.housing_mm - kFrontEnd_mm), spindle.housing_mm};
  return {{"T_front_degC", Role::bearing, mean_of_housing(cells, cells.front, thermal::plus_x)},
          {"T_rear_degC", Role::bearing, mean_of_housing(cells, cells.rear, thermal::plus_x)},
          {"T_motor_degC", Role::structure, mean_of_housing(cells, cells.motor, thermal::plus_x)},
          {"T_housing_degC", Role::housing, mean_of_housing(cells, front_end, thermal::plus_y)},
          {"T_coolant_degC", Role::coolant, one_node(cells, cells.tank())},
          {"T_head_degC", Role::structure, one_node(cells, cells.head())},
          {"T_column_degC", Role::structure, one_node(cells, cells.column_front())}};
}

// The machine's state in time, and the heat that has passed.
class Machine {
 public:
  Machine(const FiniteVolumeSpindle& spindle, const DutyPlan& plan, const Mechanisms& mechanisms)
      : spindle_(spindle), plan_(plan), mechanisms_(mechanisms), cells_(thermal::cells_of(spindle)) {
    Mechanisms steady = mechanisms;
    steady.thermostat = false;
    const thermal::Network network = network_of(spindle, steady, cells_, 0.0);
    const thermal::Heat heat = sources_of(spindle, steady, cells_, 0.0, 0.0);
    const VectorXd guess = VectorXd::Constant(cells_.nodes(), spindle.set_point_degC);
    const thermal::ImplicitStep forever(network, std::numeric_limits<double>::infinity(), heat, guess);
    temperature_degC_ = start_degC_ =
        forever.next(guess, surroundings_degC(plan.time_s.front()), heat).temperature_degC;
    expect_finite();
  }

  const thermal::Cells& cells() const { return cells_; }
  const VectorXd& temperature_degC() const { return temperature_degC_; }
  VectorXd rise_K() const { return temperature_degC_ - start_degC_; }

  HeatBalance balance() const {
    HeatBalance balance = balance_;
    balance.stored_J = network_.capacity_J_per_K.size() == 0 ? 0.0 : network_.capacity_J_per_K.dot(rise_K());
    return balance;
  }

  // Over a time in which the duty does not change.
  void advance(double from_s, double to_s, double longest_step_s) {
    const Duty duty = duty_at(plan_, from_s);
    const double steps = std::max(1.0, std::ceil((to_s - from_s) / longest_step_s - 1e-9));
    const double step_s = (to_s - from_s) / steps;
    const thermal::Heat heat = sources_of(spindle_, mechanisms_, cells_, duty.speed_rpm, duty.load_W);
    for (double step = 1.0; step <= steps; ++step) {
      one_step(duty, heat, step_s, surroundings_degC(from_s + step * step_s));
    }
  }

 private:
  VectorXd surroundings_degC(double at_s) const {
    const double room = room_degC(plan_, mechanisms_.room ? at_s : plan_.time_s.front());
    return Eigen::Vector2d(room, spindle_.set_point_degC);
  }

  void one_step(const Duty& duty, const thermal::Heat& sources, double step_s, const VectorXd& surroundings_degC) {
    expect_factored(duty, sources, step_s);
    switch_chiller();
    const bool chilled = mechanisms_.thermostat && chiller_on_;
    const thermal::Heat heat = [&](const VectorXd& temperature_degC) {
      VectorXd heat_W = sources(temperature_degC);
      if (chilled) heat_W[cells_.tank()] -= spindle_.chiller_W;
      return heat_W;
    };
    const thermal::StepResult stepped = implicit_->next(temperature_degC_, surroundings_degC, heat);
    temperature_degC_ = stepped.temperature_degC;
    expect_finite();
    stale_ = stepped.repetitions > kManyRepetitions;

    const double chiller_W = chilled ? spindle_.chiller_W : 0.0;
    const VectorXd given = given_W(network_, temperature_degC_, surroundings_degC);
    balance_.source_J += (stepped.heat_W.sum() + chiller_W) * implicit_step_s_;
    balance_.room_J += given[thermal::room] * implicit_step_s_;
    balance_.chiller_J += (given[thermal::set_point] + chiller_W) * implicit_step_s_;
  }

  void expect_finite() const {
    if (temperature_degC_.allFinite()) return;
    throw Error("spindle: expected finite temperatures of these masses, conductances, oil and speeds, found others.");
  }

  // Steps that differ by rounding alone share one matrix.
  void expect_factored(const Duty& duty, const thermal::Heat& sources, double step_s) {
    const bool same_network = implicit_ && duty.speed_rpm == speed_rpm_;
    if (same_network && !stale_ && std::abs(step_s - implicit_step_s_) < 1e-9 * step_s) return;
    if (!same_network) network_ = network_of(spindle_, mechanisms_, cells_, duty.speed_rpm);
    speed_rpm_ = duty.speed_rpm;
    implicit_step_s_ = step_s;
    implicit_ = std::make_unique<thermal::ImplicitStep>(network_, step_s, sources, temperature_degC_);
  }

  void switch_chiller() {
    const double above_K = temperature_degC_[cells_.tank()] - spindle_.set_point_degC;
    if (above_K > spindle_.hysteresis_K / 2.0) chiller_on_ = true;
    if (above_K < -spindle_.hysteresis_K / 2.0) chiller_on_ = false;
  }

  static constexpr int kManyRepetitions = 5;

  const FiniteVolumeSpindle& spindle_;
  const DutyPlan& plan_;
  const Mechanisms mechanisms_;
  const thermal::Cells cells_;
  VectorXd start_degC_, temperature_degC_;
  bool chiller_on_ = false;
  thermal::Network network_;  // at speed_rpm_
  double speed_rpm_ = 0.0;
  std::unique_ptr<thermal::ImplicitStep> implicit_;  // of network_ over implicit_step_s_
  double implicit_step_s_ = 0.0;
  bool stale_ = false;  // the slopes it was factored with are those of other temperatures
  HeatBalance balance_;
};

// Rows of the run, filled as the machine goes.
class Log {
 public:
  Log(const FiniteVolumeSpindle& spindle, const DutyPlan& plan, const Mechanisms& mechanisms,
      const thermal::Cells& cells)
      : spindle_(spindle),
        plan_(plan),
        centrifugal_(mechanisms.centrifugal),
        sensors_(sensors_of(spindle, cells)),
        tip_um_per_K_(tip_um_per_K(spindle, mechanisms, cells)) {
    Series& log = run_.sensors;
    log.columns = {{"speed_rpm", Role::speed, {}}, {"load_W", Role::load, {}}};
    for (const Sensor& sensor : sensors_) log.columns.push_back({sensor.name, sensor.role, {}});
    log.columns.push_back({"T_room_degC", Role::ambient, {}});
    for (const char* name : {"x_um", "y_um", "z_um"}) run_.truth.columns.push_back({name, Role::measured, {}});
    for (const std::string_view name : thermal::kCauses) {
      run_.truth.columns.push_back({std::string(name), Role::measured, {}});
    }
  }

  void add(double at_s, const Machine& machine) {
    const Duty duty = duty_at(plan_, at_s);
    std::vector<double> row{duty.speed_rpm, duty.load_W};
    for (const Sensor& sensor : sensors_) row.push_back(sensor.weights.dot(machine.temperature_degC()));
    row.push_back(room_degC(plan_, at_s));
    append(run_.sensors, at_s, row);

    VectorXd cause_um = tip_um_per_K_ * machine.rise_K();
    if (centrifugal_) cause_um[thermal::z_centrifugal] += thermal::centrifugal_um(spindle_, duty.speed_rpm);
    row = {0.0, 0.0, 0.0};
    for (Index cause = 0; cause < cause_um.size(); ++cause) {
      row[static_cast<std::size_t>(thermal::kCauses[static_cast<std::size_t>(cause)][0] - 'x')] += cause_um[cause];
      row.push_back(cause_um[cause]);
    }
    append(run_.truth, at_s, row);
  }

  void add_profile(double at_s, const Machine& machine) {
    ShaftProfile profile{.time_s = at_s};
    for (std::size_t i = 0; i < machine.cells().shaft.size(); ++i) {
      profile.shaft.x_mm.push_back(machine.cells().shaft[i].middle_mm());
      profile.shaft.degC.push_back(machine.temperature_degC()[machine.cells().shaft_node(i)]);
    }
    run_.profiles.push_back(std::move(profile));
  }

  ThermalRun run(const HeatBalance& balance) && {
    run_.balance = balance;
    return std::move(run_);
  }

 private:
  static void append(Series& series, double at_s, const std::vector<double>& row) {
    series.time_s.push_back(at_s);
    for (std::size_t column = 0; column < row.size(); ++column) series.columns[column].values.push_back(row[column]);
  }

  const FiniteVolumeSpindle& spindle_;
  const DutyPlan& plan_;
  bool centrifugal_;
  std::vector<Sensor> sensors_;
  Eigen::MatrixXd tip_um_per_K_;
  ThermalRun run_;
};

}  // namespace

ThermalRun run_of(const FiniteVolumeSpindle& spindle, const DutyPlan& plan, const Mechanisms& mechanisms,
                  const ThermalClock& clock) {
  thermal::check(spindle);
  thermal::check(plan, clock);
  Machine machine(spindle, plan, mechanisms);
  Log log(spindle, plan, mechanisms, machine.cells());
  const double start_s = plan.time_s.front();
  const std::size_t intervals = thermal::intervals_of(plan, clock);
  auto profile_s = clock.profile_s.begin();
  const auto keep_profile = [&](double at_s) {
    if (profile_s == clock.profile_s.end() || *profile_s != at_s) return;
    log.add_profile(at_s, machine);
    ++profile_s;
  };
  log.add(start_s, machine);
  keep_profile(start_s);
  double at_s = start_s;
  for (std::size_t row = 1; row <= intervals; ++row) {
    const double row_s = start_s + static_cast<double>(row) * clock.interval_s;
    while (at_s < row_s) {
      const auto change = std::upper_bound(plan.time_s.begin(), plan.time_s.end(), at_s);
      double to_s = change == plan.time_s.end() ? row_s : std::min(*change, row_s);
      if (profile_s != clock.profile_s.end()) to_s = std::min(to_s, *profile_s);
      machine.advance(at_s, to_s, clock.step_s);
      at_s = to_s;
      keep_profile(at_s);
    }
    log.add(row_s, machine);
  }
  return std::move(log).run(machine.balance());
}

}  // namespace ballbar

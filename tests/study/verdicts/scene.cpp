#include "scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics.hpp"

namespace ballbar::verdicts {
namespace {

constexpr double kLeastShare = 0.05;
constexpr double kLargestRange = 200.0;  // in sigmas
constexpr double kLeastSeen = 0.8;       // of d, by sensors with noise and steps

constexpr std::array<std::array<const char*, kQuantities + 1>, 4> kNames{{
    {"speed_rpm", "load_W", "T_room_degC", "T_coolant_degC", "T_housing_degC", "T_bearing_degC", "z_um"},
    {"S1_rpm", "P_motor_W", "TH1_degC", "TH2_degC", "TH3_degC", "TH4_degC", "drift_um"},
    {"n_rpm", "power_W", "air_degC", "water_in_degC", "headstock_degC", "front_bearing_degC", "x_um"},
    {"ch01_rpm", "ch02_W", "ch11_degC", "ch12_degC", "ch13_degC", "ch14_degC", "ch20_um"},
}};
constexpr std::array kRoles{Role::speed, Role::load, Role::ambient, Role::coolant, Role::housing, Role::bearing};

Plan drawn_plan(const Recipe& recipe, Chance& chance) {
  switch (recipe.course) {
    case Course::poor:
      return poor_plan(chance);
    case Course::one_speed:
      return one_speed_plan(chance);
    case Course::rich:
      break;
  }
  return rich_plan(chance);
}

Scatter drawn_scatter(Noise noise, Chance& chance) {
  if (noise == Noise::any) {
    const double kind = chance.uniform();
    noise = kind < 0.5 ? Noise::ar90 : kind < 0.8 ? Noise::ar98 : Noise::heavy;
  }
  Scatter scatter;
  scatter.sigma_um = chance.log_between(0.2, 1.0);
  scatter.time_constant_s = -75.0 / std::log(noise == Noise::ar98 ? 0.98 : 0.9);
  scatter.white_um = scatter.sigma_um * chance.between(0.02, 0.15);
  scatter.heavy = noise == Noise::heavy;
  scatter.resolution_um = 0.01;
  if (noise == Noise::coarse) {
    scatter.resolution_um = 0.1;
    scatter.sigma_um = chance.between(0.12, 0.3);
    scatter.white_um = 0.1 * scatter.sigma_um;
  }
  return scatter;
}

Conventions drawn_conventions(const Recipe& recipe, Chance& chance) {
  constexpr std::array<std::size_t, 3> kRows_s{15, 30, 60};
  Conventions conventions;
  conventions.logging = recipe.logging;
  conventions.row_s = recipe.row_s > 0 ? recipe.row_s : kRows_s[chance.below(kRows_s.size())];
  conventions.every_s = conventions.row_s * (conventions.row_s == 15 ? 4 : 2 + chance.below(2));
  conventions.most_late = recipe.most_late;
  conventions.kelvin_step = recipe.kelvin_step;
  conventions.sensor_noise_K = chance.log_between(0.003, 0.02);
  return conventions;
}

// Of a smooth random curve.
std::vector<double> fake_temperature(const Plan& plan, const std::vector<double>& time_s, double kelvin_step,
                                     Chance& chance) {
  const double tau_s = chance.log_between(300.0, 8000.0), size_K = chance.log_between(0.3, 6.0);
  double first = chance.normal(), second = 0.7 * chance.normal();
  Track track(plan[Quantity::speed].size());
  for (double& value : track) {
    first += -first / tau_s + std::sqrt(2.0 / tau_s) * chance.normal();
    second += (first - second) / tau_s;
    value = 22.0 + size_K * second;
  }
  Conventions plain;
  plain.kelvin_step = kelvin_step;
  return logged(track, Quantity::room, time_s, plain, chance);
}

}  // namespace

Scene drawn_scene(const Recipe& recipe, Chance& chance) {
  Scene scene;
  scene.plan = drawn_plan(recipe, chance);
  scene.conventions = drawn_conventions(recipe, chance);
  scene.scatter = drawn_scatter(recipe.noise, chance);
  scene.time_s = rows_of(scene.plan, scene.conventions.row_s);
  scene.base = drawn_base(scene.plan, scene.scatter.sigma_um * chance.log_between(15.0, 80.0), chance);
  scene.model = whitened(jacobian(scene.base, scene.plan, scene.time_s), scene.time_s, scene.scatter);
  const auto& names = kNames[chance.below(kNames.size())];
  for (std::size_t k = 0; k < kQuantities; ++k) scene.name[k] = names[k];
  scene.target = names[kQuantities];
  scene.states_roles = chance.happens(0.5);
  return scene;
}

Eigen::VectorXd surviving(const Track& track, const Scene& scene) {
  const std::vector<double> values = at_rows(track, scene.time_s);
  const Eigen::MatrixXd column = Eigen::Map<const Eigen::VectorXd>(values.data(), scene.model.rows());
  return surviving(Eigen::VectorXd(whitened(column, scene.time_s, scene.scatter)), scene.model);
}

std::optional<double> factor_for(const Track& track, const Scene& scene, double d, double at_once_per_K) {
  const std::vector<double> values = at_rows(track, scene.time_s);
  const Eigen::MatrixXd column = Eigen::Map<const Eigen::VectorXd>(values.data(), scene.model.rows());
  const double whole = whitened(column, scene.time_s, scene.scatter).squaredNorm();
  const double left = surviving(track, scene).squaredNorm();
  if (!(left > kLeastShare * whole) || !(left > 0.0)) return std::nullopt;
  const double factor = d / std::sqrt(left);
  if (!(factor * range(values) < kLargestRange * scene.scatter.sigma_um)) return std::nullopt;
  Scatter with_sensors = scene.scatter;
  const Conventions& conventions = scene.conventions;
  const double sensor_K = std::hypot(conventions.sensor_noise_K, conventions.kelvin_step / std::sqrt(12.0));
  const double passed_on = std::hypot(factor * at_once_per_K, scene.base.effect == "expansion" ? scene.base.gain : 0.0);
  with_sensors.white_um = std::hypot(with_sensors.white_um, passed_on * sensor_K);
  const Eigen::VectorXd seen =
      surviving(Eigen::VectorXd(whitened(column, scene.time_s, with_sensors)),
                whitened(jacobian(scene.base, scene.plan, scene.time_s), scene.time_s, with_sensors));
  if (factor * seen.norm() < kLeastSeen * d) return std::nullopt;
  return factor;
}

Made assembled(const Scene& scene, const Track& sum, const std::vector<Quantity>& needed, const Recipe& recipe,
               Chance& chance, std::optional<Quantity> not_logged) {
  const auto is_needed = [&](Quantity quantity) {
    return (!scene.base.effect.empty() && scene.base.input == quantity) ||
           std::find(needed.begin(), needed.end(), quantity) != needed.end();
  };
  std::optional<Quantity> missing = not_logged;
  const Quantity perhaps = chance.happens(0.5) ? Quantity::bearing : Quantity::coolant;
  if (!missing && chance.happens(0.6) && !is_needed(perhaps)) missing = perhaps;
  Made made;
  made.data.time_s = scene.time_s;
  for (std::size_t k = 0; k < kQuantities; ++k) {
    const auto quantity = static_cast<Quantity>(k);
    if (quantity == missing) continue;
    const Role role = scene.states_roles ? kRoles[k] : role_from_unit(unit_of(scene.name[k]));
    const Clock clock = drawn_clock(scene.conventions, chance);
    made.late_s[k] = clock.late_s;
    made.data.columns.push_back(
        {scene.name[k], role, logged(scene.plan[quantity], quantity, scene.time_s, scene.conventions, clock, chance)});
  }
  for (std::size_t k = 0; k < recipe.fakes; ++k) {
    made.data.columns.push_back({fmt::format("spare{:02}_degC", k + 1), Role::structure,
                                 fake_temperature(scene.plan, scene.time_s, recipe.kelvin_step, chance)});
  }
  Track clean = scene.base.track;
  for (std::size_t i = 0; i < sum.size(); ++i) clean[i] += sum[i];
  std::vector<double> values = at_rows(clean, scene.time_s);
  const std::vector<double> noise = drawn(scene.scatter, scene.time_s, chance);
  const double offset_um = chance.between(-20.0, 20.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = rounded(offset_um + values[i] + noise[i], scene.scatter.resolution_um);
  }
  made.data.columns.push_back({scene.target, Role::measured, std::move(values)});
  for (std::size_t k = made.data.columns.size() - 1; k > 0; --k) {
    std::swap(made.data.columns[k], made.data.columns[chance.below(k + 1)]);
  }
  made.model.targets = {scene.target};
  if (!scene.base.effect.empty()) {
    made.model.terms.push_back(term_of(scene.base.effect, {name_of(scene, scene.base.input)}));
  }
  made.sigma_um = scene.scatter.sigma_um;
  return made;
}

const std::string& name_of(const Scene& scene, Quantity quantity) {
  return scene.name[static_cast<std::size_t>(quantity)];
}

Track scaled(Track track, double factor) {
  for (double& value : track) value *= factor;
  return track;
}

}  // namespace ballbar::verdicts

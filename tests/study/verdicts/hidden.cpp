#include "hidden.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "logging.hpp"
#include "physics.hpp"

namespace ballbar::verdicts {
namespace {

constexpr std::array kTemperatures{Quantity::room, Quantity::coolant, Quantity::housing, Quantity::bearing};
constexpr std::array kInside{Quantity::housing, Quantity::bearing};

template <class Values>
Quantity one_of(const Values& values, Chance& chance) {
  return values[chance.below(values.size())];
}

double mean(const Track& track) {
  double sum = 0.0;
  for (const double value : track) sum += value;
  return sum / static_cast<double>(track.size());
}

// The side that is warmer on average is the hot one.
std::pair<Quantity, Quantity> two_sides(const Plan& plan, Chance& chance) {
  Quantity hot = one_of(kTemperatures, chance), cold = hot;
  while (cold == hot) cold = one_of(kTemperatures, chance);
  if (mean(plan[hot]) < mean(plan[cold])) std::swap(hot, cold);
  return {hot, cold};
}

}  // namespace

Hidden drawn_effect(std::string_view effect, const Plan& plan, double row_s, Chance& chance) {
  const double slowest_s = std::min(15000.0, 0.5 * static_cast<double>(plan.span_s));
  const auto lag_s = [&] { return chance.log_between(std::max(100.0, 2.0 * row_s), slowest_s); };
  const Track& speed = plan[Quantity::speed];
  const std::string name(effect);
  if (effect == "centrifugal_shift") {
    return {name, {Quantity::speed}, {{"gain_um_per_krpm_p", 1.0, true}}, power_of_speed(speed, 2.0)};
  }
  if (effect == "cooling_asymmetry") {
    const double ratio = chance.log_between(1.6, 6.0), turning_s = chance.log_between(100.0, slowest_s / ratio);
    return {name,
            {Quantity::speed},
            {{"gain_um_per_krpm_a", 1.0, true},
             {"time_constant_turning_s", turning_s},
             {"time_constant_at_rest_s", ratio * turning_s}},
            heat_with_two_lags(speed, 5.0 / 3.0, turning_s, ratio * turning_s)};
  }
  if (effect == "viscosity_feedback") {
    const Quantity inside = one_of(kInside, chance);
    const double tau_s = lag_s(), loss_per_K = chance.log_between(0.01, 0.08);
    return {name,
            {Quantity::speed, inside},
            {{"gain_um_per_krpm", 1.0, true}, {"time_constant_s", tau_s}, {"viscosity_loss_per_K", loss_per_K}},
            low_pass(thinning_friction(speed, plan[inside], loss_per_K), tau_s)};
  }
  if (effect == "load_heating") {
    const double tau_s = lag_s();
    return {name,
            {Quantity::load},
            {{"gain_um_per_unit", 1.0, true}, {"time_constant_s", tau_s}},
            low_pass(plan[Quantity::load], tau_s)};
  }
  if (effect == "gradient_bending") {
    const auto [hot, cold] = two_sides(plan, chance);
    const double tau_s = chance.happens(0.5) ? 0.0 : lag_s();
    const Track sides = rise(difference(plan[hot], plan[cold]));
    return {name,
            {hot, cold},
            {{"gain_um_per_K", 1.0, true}, {"time_constant_s", tau_s}},
            tau_s > 0.0 ? low_pass(sides, tau_s) : sides,
            tau_s > 0.0 ? 0.0 : std::numbers::sqrt2};
  }
  if (effect == "bearing_rings") {
    const bool first = chance.happens(0.5);
    const Quantity inner = kInside[first ? 0 : 1], outer = kInside[first ? 1 : 0];
    return {name, {inner, outer}, {{"gain", 1.0, true}}, ring_growth(plan[inner], plan[outer]), 0.633};
  }
  const Quantity input = one_of(kTemperatures, chance);
  const Track& signal = plan[input];
  if (effect == "lagged_expansion") {
    const double tau_s = lag_s();
    return {name, {input}, {{"gain_um_per_K", 1.0, true}, {"time_constant_s", tau_s}}, low_pass(rise(signal), tau_s)};
  }
  if (effect == "preload_loss") {
    const Track up = rise(signal);
    const double threshold = chance.between(0.2, 0.7) * *std::max_element(up.begin(), up.end());
    return {name,
            {input},
            {{"gain_um_per_unit", 1.0, true}, {"threshold_unit", threshold}},
            beyond(signal, threshold),
            1.0};
  }
  if (effect == "play_hysteresis") {
    const double half_width = chance.between(0.05, 0.2) * range(signal);
    return {name,
            {input},
            {{"gain_um_per_unit", 1.0, true}, {"half_width_unit", half_width}},
            held_back(signal, half_width),
            1.0};
  }
  return {name, {input}, {{"gain_um_per_K", 1.0, true}}, rise(signal), 1.0};  // expansion
}

Track unit_track(const Base& base, const Plan& plan, double time_constant_s) {
  if (base.effect.empty()) return Track(plan[Quantity::speed].size(), 0.0);
  const Track input =
      base.input == Quantity::speed ? power_of_speed(plan[base.input], base.exponent) : rise(plan[base.input]);
  return time_constant_s > 0.0 ? low_pass(input, time_constant_s) : input;
}

Base drawn_base(const Plan& plan, double range_um, Chance& chance) {
  Base base;
  const double kind = chance.uniform();
  if (kind < 0.6) {
    base = {"speed_heating", Quantity::speed, 1.0, chance.log_between(600.0, 6000.0), 5.0 / 3.0, {}};
  } else if (kind < 0.8) {
    base = {"expansion", Quantity::housing, 1.0, 0.0, 0.0, {}};
  } else if (kind < 0.9) {
    base = {"lagged_expansion", Quantity::room, 1.0, chance.log_between(900.0, 6000.0), 0.0, {}};
  }
  base.track = unit_track(base, plan, base.time_constant_s);
  if (base.effect.empty()) return base;
  base.gain = (chance.happens(0.5) ? 1.0 : -1.0) * range_um / range(base.track);
  for (double& value : base.track) value *= base.gain;
  return base;
}

Eigen::MatrixXd jacobian(const Base& base, const Plan& plan, const std::vector<double>& time_s) {
  const Eigen::Index columns = base.effect.empty() ? 1 : base.time_constant_s > 0.0 ? 3 : 2;
  Eigen::MatrixXd result(static_cast<Eigen::Index>(time_s.size()), columns);
  result.col(0).setOnes();
  const auto column = [&](double tau_s) {
    const std::vector<double> values = at_rows(unit_track(base, plan, tau_s), time_s);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), result.rows()));
  };
  if (columns > 1) result.col(1) = column(base.time_constant_s);
  if (columns > 2) {
    const double step = 1e-3;  // relative
    result.col(2) = (column(base.time_constant_s * (1.0 + step)) - column(base.time_constant_s * (1.0 - step))) / step;
  }
  return result;
}

}  // namespace ballbar::verdicts

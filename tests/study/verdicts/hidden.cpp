#include "hidden.hpp"

#include <algorithm>
#include <cmath>
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

Track added_by(const Hidden& hidden, const Plan& plan, const Plan& first) {
  const auto shape = [&](std::size_t k) { return hidden.parameters[k].value; };
  const auto input = [&](std::size_t k) -> const Track& { return plan[hidden.inputs[k]]; };
  // How much warmer the plan begins than the first one.
  const auto begins_K = [&](std::size_t k) { return input(k).front() - first[hidden.inputs[k]].front(); };
  Track track;
  if (hidden.effect == "centrifugal_shift") {
    track = power_of_speed(input(0), 2.0);
  } else if (hidden.effect == "cooling_asymmetry") {
    track = heat_with_two_lags(input(0), 5.0 / 3.0, shape(1), shape(2));
  } else if (hidden.effect == "viscosity_feedback") {
    track = low_pass(thinning_friction(input(0), input(1), shape(2)), shape(1));
    const double thinner = std::exp(-shape(2) * begins_K(1));
    if (thinner != 1.0) {
      for (double& value : track) value *= thinner;
    }
  } else if (hidden.effect == "step") {
    track.assign(plan[Quantity::speed].size(), 0.0);
    std::fill(track.begin() + static_cast<std::ptrdiff_t>(shape(1)), track.end(), 1.0);
  } else if (hidden.effect == "load_heating") {
    track = low_pass(input(0), shape(1));
  } else if (hidden.effect == "gradient_bending") {
    track = rise(difference(input(0), input(1)));
    if (shape(1) > 0.0) track = low_pass(track, shape(1));
  } else if (hidden.effect == "bearing_rings") {
    track = ring_growth(input(0), input(1));
  } else if (hidden.effect == "lagged_expansion") {
    track = low_pass(rise(input(0)), shape(1));
  } else if (hidden.effect == "preload_loss") {
    track = beyond(input(0), shape(1) - begins_K(0));
  } else if (hidden.effect == "play_hysteresis") {
    track = held_back(input(0), shape(1));
  } else {
    track = rise(input(0));  // expansion
  }
  const double gain = hidden.parameters.front().value;
  if (gain != 1.0) {
    for (double& value : track) value *= gain;
  }
  return track;
}

Hidden drawn_effect(std::string_view effect, const Plan& plan, double row_s, Chance& chance) {
  const double slowest_s = std::min(15000.0, 0.5 * static_cast<double>(plan.span_s));
  const auto lag_s = [&] { return chance.log_between(std::max(100.0, 2.0 * row_s), slowest_s); };
  Hidden hidden{std::string(effect), {}, {}, {}, 0.0};
  if (effect == "centrifugal_shift") {
    hidden.inputs = {Quantity::speed};
    hidden.parameters = {{"gain_um_per_krpm_p", 1.0, true}};
  } else if (effect == "cooling_asymmetry") {
    const double ratio = chance.log_between(1.6, 6.0), turning_s = chance.log_between(100.0, slowest_s / ratio);
    hidden.inputs = {Quantity::speed};
    hidden.parameters = {{"gain_um_per_krpm_a", 1.0, true},
                         {"time_constant_turning_s", turning_s},
                         {"time_constant_at_rest_s", ratio * turning_s}};
  } else if (effect == "viscosity_feedback") {
    const Quantity inside = one_of(kInside, chance);
    const double tau_s = lag_s(), loss_per_K = chance.log_between(0.01, 0.08);
    hidden.inputs = {Quantity::speed, inside};
    hidden.parameters = {
        {"gain_um_per_krpm", 1.0, true}, {"time_constant_s", tau_s}, {"viscosity_loss_per_K", loss_per_K}};
  } else if (effect == "step") {
    const double share = chance.between(0.1, 0.9);
    hidden.parameters = {{"gain_um", 1.0, true}, {"onset_s", std::floor(share * static_cast<double>(plan.span_s))}};
  } else if (effect == "load_heating") {
    hidden.inputs = {Quantity::load};
    hidden.parameters = {{"gain_um_per_unit", 1.0, true}, {"time_constant_s", lag_s()}};
  } else if (effect == "gradient_bending") {
    const auto [hot, cold] = two_sides(plan, chance);
    const double tau_s = chance.happens(0.5) ? 0.0 : lag_s();
    hidden.inputs = {hot, cold};
    hidden.parameters = {{"gain_um_per_K", 1.0, true}, {"time_constant_s", tau_s}};
    hidden.at_once_per_K = tau_s > 0.0 ? 0.0 : std::numbers::sqrt2;
  } else if (effect == "bearing_rings") {
    const bool first = chance.happens(0.5);
    hidden.inputs = {kInside[first ? 0 : 1], kInside[first ? 1 : 0]};
    hidden.parameters = {{"gain", 1.0, true}};
    hidden.at_once_per_K = 0.633;
  } else {
    const Quantity input = one_of(kTemperatures, chance);
    const Track& signal = plan[input];
    hidden.inputs = {input};
    hidden.at_once_per_K = 1.0;
    if (effect == "lagged_expansion") {
      hidden.parameters = {{"gain_um_per_K", 1.0, true}, {"time_constant_s", lag_s()}};
      hidden.at_once_per_K = 0.0;
    } else if (effect == "preload_loss") {
      const Track up = rise(signal);
      const double threshold = chance.between(0.2, 0.7) * *std::max_element(up.begin(), up.end());
      hidden.parameters = {{"gain_um_per_unit", 1.0, true}, {"threshold_unit", threshold}};
    } else if (effect == "play_hysteresis") {
      hidden.parameters = {{"gain_um_per_unit", 1.0, true},
                           {"half_width_unit", chance.between(0.05, 0.2) * range(signal)}};
    } else {
      hidden.parameters = {{"gain_um_per_K", 1.0, true}};  // expansion
    }
  }
  hidden.unit = added_by(hidden, plan, plan);
  return hidden;
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

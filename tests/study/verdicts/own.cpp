#include "own.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "physics.hpp"
#include "scene.hpp"

namespace ballbar::verdicts {
namespace {

constexpr int kMostTries = 2000;
constexpr double kLargestRange = 200.0;  // in sigmas

Eigen::VectorXd at_rows_whitened(const Track& track, const Scene& scene) {
  const std::vector<double> values = at_rows(track, scene.time_s);
  const Eigen::MatrixXd column =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return whitened(column, scene.time_s, scene.scatter);
}

// d of what a constant and one track leave of the truth.
double misfit(const Eigen::VectorXd& truth, const Track& track, const Scene& scene) {
  Eigen::MatrixXd model(truth.size(), 2);
  model.col(0) = at_rows_whitened(Track(track.size(), 1.0), scene);
  model.col(1) = at_rows_whitened(track, scene);
  return surviving(truth, model).norm();
}

// The least of it over the time constant: a search on a grid, then by thirds.
double misfit_over_lags(const Eigen::VectorXd& truth, const Track& input, const Scene& scene) {
  const auto at = [&](double log_tau) { return misfit(truth, low_pass(input, std::exp(log_tau)), scene); };
  double best = std::log(10.0), step = 0.4;
  for (double log_tau = best; log_tau < std::log(2e5); log_tau += step) {
    if (at(log_tau) < at(best)) best = log_tau;
  }
  for (; step > 0.004; step /= 2.0) {
    for (const double next : {best - step, best + step}) {
      if (at(next) < at(best)) best = next;
    }
  }
  return at(best);
}

struct Misheld {
  Base base;       // the truth, gain 1
  OwnTruth truth;  // its effect: not yet
  double misfit = 0.0;
};

Misheld with_exponent(const Scene& scene, Chance& chance) {
  Misheld one;
  one.base = {
      "speed_heating", Quantity::speed, 1.0, chance.log_between(600.0, 6000.0), chance.happens(0.5) ? 1.0 : 2.0, {}};
  one.base.track = unit_track(one.base, scene.plan, one.base.time_constant_s);
  one.truth = {"", "exponent", 5.0 / 3.0, one.base.exponent};
  one.misfit = misfit_over_lags(at_rows_whitened(one.base.track, scene),
                                power_of_speed(scene.plan[Quantity::speed], 5.0 / 3.0), scene);
  return one;
}

Misheld with_time_constant(const Scene& scene, Chance& chance) {
  Misheld one;
  const double tau_s = chance.log_between(600.0, 6000.0), factor = chance.log_between(2.0, 4.0);
  if (chance.happens(0.7)) {
    one.base = {"speed_heating", Quantity::speed, 1.0, tau_s, 5.0 / 3.0, {}};
  } else {
    const Quantity input = chance.happens(0.5) ? Quantity::room : Quantity::housing;
    one.base = {"lagged_expansion", input, 1.0, tau_s, 0.0, {}};
  }
  one.base.track = unit_track(one.base, scene.plan, tau_s);
  one.truth = {"", "time_constant_s", chance.happens(0.5) ? tau_s * factor : tau_s / factor, tau_s};
  one.misfit = misfit(at_rows_whitened(one.base.track, scene), unit_track(one.base, scene.plan, one.truth.held), scene);
  return one;
}

}  // namespace

Made made_own(Own own, std::string_view stream, std::uint64_t seed) {
  Chance chance(stream, seed);
  for (int tries = 0; tries < kMostTries; ++tries) {
    const Recipe recipe;
    Scene scene = drawn_scene(recipe, chance);
    Misheld one = own == Own::exponent ? with_exponent(scene, chance) : with_time_constant(scene, chance);
    const double d = chance.between(10.0, 15.0), factor = d / one.misfit;
    if (!(factor * range(one.base.track) < kLargestRange * scene.scatter.sigma_um)) continue;
    one.base.gain = chance.happens(0.5) ? factor : -factor;
    one.base.track = scaled(std::move(one.base.track), one.base.gain);
    scene.base = one.base;
    Made set = assembled(scene, Track(scene.base.track.size(), 0.0), {}, recipe, chance);
    Term& term = set.model.terms.front();
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      if (term.effect->parameters[k].name != one.truth.parameter) continue;
      term.settings[k].held = true;
      term.settings[k].start = one.truth.held;
      term.settings[k].stated = true;
    }
    one.truth.effect = label_of(term);
    set.own = one.truth;
    set.drivers = {name_of(scene, scene.base.input)};
    set.what = fmt::format("{} of {} is {:.4g}, held at {:.4g}", one.truth.parameter, one.truth.effect, one.truth.value,
                           one.truth.held);
    set.d = d;
    set.seed = seed;
    return set;
  }
  throw std::runtime_error(fmt::format("{} seed {}: expected a model to hold wrongly, found none", stream, seed));
}

}  // namespace ballbar::verdicts

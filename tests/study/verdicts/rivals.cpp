#include "rivals.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "physics.hpp"

namespace ballbar::verdicts {
namespace {

constexpr std::array kTemperatures{Quantity::room, Quantity::coolant, Quantity::housing, Quantity::bearing};

std::vector<double> lags(double least_s, double most_s, double ratio) {
  std::vector<double> result;
  for (double tau_s = least_s; tau_s < most_s; tau_s *= ratio) result.push_back(tau_s);
  return result;
}

struct Bank {
  const Scene& scene;
  Rivals rivals;
  std::vector<std::vector<double>> columns;

  void add(const char* effect, std::vector<Quantity> inputs, const Track& track) {
    if (!(range(track) > 0.0)) return;
    rivals.effect.emplace_back(effect);
    rivals.inputs.push_back(std::move(inputs));
    columns.push_back(at_rows(track, scene.time_s));
  }
};

void add_of_speed(Bank& bank) {
  const Plan& plan = bank.scene.plan;
  const Track& speed = plan[Quantity::speed];
  bank.add("centrifugal_shift", {Quantity::speed}, power_of_speed(speed, 2.0));
  for (const double exponent : {1.0, 5.0 / 3.0, 2.0}) {
    const Track heat = power_of_speed(speed, exponent);
    for (const double tau_s : lags(10.0, 3e4, 1.3)) bank.add("speed_heating", {Quantity::speed}, low_pass(heat, tau_s));
  }
  for (const double tau_s : lags(10.0, 3e4, 1.3))
    bank.add("load_heating", {Quantity::load}, low_pass(plan[Quantity::load], tau_s));
  for (const double tau_s : lags(60.0, 2e4, 1.5)) {
    for (const double ratio : {0.35, 0.6, 1.6, 2.2, 3.2, 4.5, 6.5}) {
      bank.add("cooling_asymmetry", {Quantity::speed}, heat_with_two_lags(speed, 5.0 / 3.0, tau_s, ratio * tau_s));
    }
    for (const Quantity inside : {Quantity::housing, Quantity::bearing}) {
      for (const double loss : {0.01, 0.02, 0.035, 0.06, 0.1}) {
        bank.add("viscosity_feedback", {Quantity::speed, inside},
                 low_pass(thinning_friction(speed, plan[inside], loss), tau_s));
      }
    }
  }
}

void add_of_temperatures(Bank& bank) {
  const Plan& plan = bank.scene.plan;
  const std::vector<double> taus_s = lags(60.0, 2e4, 1.25);
  for (std::size_t k = 0; k < kTemperatures.size(); ++k) {
    const Quantity input = kTemperatures[k];
    const Track up = rise(plan[input]);
    bank.add("expansion", {input}, up);
    for (const double tau_s : taus_s) bank.add("lagged_expansion", {input}, low_pass(up, tau_s));
    const double most = *std::max_element(up.begin(), up.end());
    for (int share = 1; share < 40; ++share) bank.add("preload_loss", {input}, beyond(up, 0.025 * share * most));
    for (int share = 1; share < 20; ++share) {
      bank.add("play_hysteresis", {input}, held_back(up, 0.02 * share * range(up)));
    }
    for (std::size_t other = 0; other < k; ++other) {
      const Track sides = rise(difference(plan[input], plan[kTemperatures[other]]));
      bank.add("gradient_bending", {input, kTemperatures[other]}, sides);
      for (const double tau_s : taus_s) {
        bank.add("gradient_bending", {input, kTemperatures[other]}, low_pass(sides, tau_s));
      }
    }
  }
  const Track &housing = plan[Quantity::housing], &bearing = plan[Quantity::bearing];
  bank.add("bearing_rings", {Quantity::bearing, Quantity::housing}, ring_growth(bearing, housing));
  bank.add("bearing_rings", {Quantity::housing, Quantity::bearing}, ring_growth(housing, bearing));
}

std::vector<double> prior_of(const Rivals& rivals) {
  std::map<std::string, std::map<std::vector<Quantity>, double>> shapes;  // by effect and columns
  for (std::size_t k = 0; k < rivals.effect.size(); ++k) shapes[rivals.effect[k]][rivals.inputs[k]] += 1.0;
  std::vector<double> prior;
  prior.reserve(rivals.effect.size());
  for (std::size_t k = 0; k < rivals.effect.size(); ++k) {
    const auto& columns = shapes[rivals.effect[k]];
    prior.push_back(1.0 / static_cast<double>(columns.size()) / columns.at(rivals.inputs[k]));
  }
  return prior;
}

}  // namespace

Rivals rivals(const Scene& scene) {
  Bank bank{scene, {}, {}};
  add_of_speed(bank);
  add_of_temperatures(bank);
  Eigen::MatrixXd columns(scene.model.rows(), static_cast<Eigen::Index>(bank.columns.size()));
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    columns.col(k) =
        Eigen::Map<const Eigen::VectorXd>(bank.columns[static_cast<std::size_t>(k)].data(), columns.rows());
  }
  columns = whitened(columns, scene.time_s, scene.scatter);
  const Eigen::VectorXd whole = columns.colwise().norm();
  Eigen::MatrixXd even = scene.model;
  even.colwise().normalize();
  columns -= even * even.colPivHouseholderQr().solve(columns);
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const double left = columns.col(k).norm();  // rounding error where the base model makes all of it
    columns.col(k) *= left > 1e-6 * whole(k) ? 1.0 / left : 0.0;
  }
  bank.rivals.left = std::move(columns);
  bank.rivals.prior = prior_of(bank.rivals);
  return std::move(bank.rivals);
}

Apart apart(const Eigen::VectorXd& left, const Rivals& rivals, const IsRival& is_rival) {
  const Eigen::VectorXd along = rivals.left.transpose() * left;
  const double whole = left.squaredNorm();
  Apart result{std::sqrt(whole), {}};
  for (Eigen::Index k = 0; k < along.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (!is_rival(rivals.effect[at], rivals.inputs[at])) continue;
    const double d = std::sqrt(std::max(0.0, whole - along(k) * along(k)));
    if (d < result.d) result = {d, rivals.effect[at]};
  }
  return result;
}

Ideal ideal(const Eigen::VectorXd& left, const Rivals& rivals, const IsRival& is_rival) {
  const Eigen::VectorXd along = rivals.left.transpose() * left;
  const double most = 0.5 * along.cwiseAbs2().maxCoeff();
  double truth = 0.0;
  std::map<std::string, double> others;
  for (Eigen::Index k = 0; k < along.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double weight = rivals.prior[at] * std::exp(0.5 * along(k) * along(k) - most);
    if (is_rival(rivals.effect[at], rivals.inputs[at])) {
      others[rivals.effect[at]] += weight;
    } else {
      truth += weight;
    }
  }
  double sum = truth, largest = 0.0;
  Ideal result;
  for (const auto& [effect, weight] : others) {
    sum += weight;
    if (weight <= largest) continue;
    largest = weight;
    result.rival = effect;
  }
  result.p = truth / sum;
  return result;
}

}  // namespace ballbar::verdicts

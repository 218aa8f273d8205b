#include "spindle/thermal_network.hpp"

#include <cmath>

namespace ballbar::thermal {
namespace {

constexpr double kSmall_K = 1e-9;
constexpr int kMostRepetitions = 200;

// -dq/dT at T, over a hundredth of a kelvin either way; never negative, so that the matrix stays positive definite.
Eigen::VectorXd slope_W_per_K(const Heat& heat, const Eigen::VectorXd& temperature_degC) {
  constexpr double kHalf_K = 0.01;
  const Eigen::VectorXd above = heat((temperature_degC.array() + kHalf_K).matrix());
  const Eigen::VectorXd below = heat((temperature_degC.array() - kHalf_K).matrix());
  return ((below - above) / (2.0 * kHalf_K)).cwiseMax(0.0);
}

Eigen::SparseMatrix<double> matrix_of(const Network& network, const Eigen::VectorXd& diagonal_W_per_K) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(4 * network.links.size() + network.outlets.size() +
                  static_cast<std::size_t>(diagonal_W_per_K.size()));
  for (Eigen::Index i = 0; i < diagonal_W_per_K.size(); ++i) entries.emplace_back(i, i, diagonal_W_per_K[i]);
  for (const auto& [a, b, conductance] : network.links) {
    entries.emplace_back(a, a, conductance);
    entries.emplace_back(b, b, conductance);
    entries.emplace_back(a, b, -conductance);
    entries.emplace_back(b, a, -conductance);
  }
  for (const Outlet& outlet : network.outlets) entries.emplace_back(outlet.node, outlet.node, outlet.W_per_K);
  Eigen::SparseMatrix<double> matrix(diagonal_W_per_K.size(), diagonal_W_per_K.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

ImplicitStep::ImplicitStep(const Network& network, double step_s, const Heat& heat,
                           const Eigen::VectorXd& temperature_degC)
    : stored_W_per_K_(network.capacity_J_per_K / step_s),
      outlets_(network.outlets),
      slope_W_per_K_(slope_W_per_K(heat, temperature_degC)),
      factored_(matrix_of(network, stored_W_per_K_ + slope_W_per_K_)) {}

// (C/dt + G + s) T' = C/dt T + G_b T_b + q(T'') + s T'', T'' the T' of the last repetition
StepResult ImplicitStep::next(const Eigen::VectorXd& temperature_degC, const Eigen::VectorXd& surroundings_degC,
                              const Heat& heat) const {
  Eigen::VectorXd given = stored_W_per_K_.cwiseProduct(temperature_degC);
  for (const auto& [node, surroundings, conductance] : outlets_) {
    given[node] += conductance * surroundings_degC[surroundings];
  }
  StepResult stepped;
  stepped.temperature_degC = temperature_degC;
  for (double change_K = 1.0; change_K > kSmall_K && stepped.repetitions < kMostRepetitions; ++stepped.repetitions) {
    const Eigen::VectorXd before = stepped.temperature_degC;
    const Eigen::VectorXd heat_W = heat(before);
    stepped.temperature_degC = factored_.solve(given + heat_W + slope_W_per_K_.cwiseProduct(before));
    const Eigen::VectorXd difference = stepped.temperature_degC - before;
    stepped.heat_W = heat_W - slope_W_per_K_.cwiseProduct(difference);
    change_K = slope_W_per_K_.isZero(0.0) ? 0.0 : difference.cwiseAbs().maxCoeff();
  }
  return stepped;
}

Eigen::VectorXd given_W(const Network& network, const Eigen::VectorXd& temperature_degC,
                        const Eigen::VectorXd& surroundings_degC) {
  Eigen::VectorXd given = Eigen::VectorXd::Zero(surroundings_degC.size());
  for (const auto& [node, surroundings, conductance] : network.outlets) {
    given[surroundings] += conductance * (temperature_degC[node] - surroundings_degC[surroundings]);
  }
  return given;
}

}  // namespace ballbar::thermal

#include "spindle/thermal_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ballbar::thermal {
namespace {

constexpr double kForever_s = std::numeric_limits<double>::infinity();

Eigen::VectorXd none(const Eigen::VectorXd& temperature_degC) { return Eigen::VectorXd::Zero(temperature_degC.size()); }

Eigen::VectorXd degC(std::initializer_list<double> values) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

// 1000 J/K through 10 W/K: time constant 100 s.
Network one_body() { return {degC({1000.0}), {}, {{0, 0, 10.0}}}; }

Eigen::VectorXd after(const Network& network, double step_s, int steps, Eigen::VectorXd temperature_degC,
                      const Heat& heat = none) {
  const ImplicitStep step(network, step_s, heat, temperature_degC);
  for (int i = 0; i < steps; ++i) temperature_degC = step.next(temperature_degC, degC({0.0}), heat).temperature_degC;
  return temperature_degC;
}

// T / (1 + dt / tau) a step: 100 / 1.5^2.
TEST(ThermalNetwork, StepsOfOneBodyByHand) {
  EXPECT_NEAR(after(one_body(), 50.0, 2, degC({100.0}))[0], 100.0 / 2.25, 1e-12);
}

// 100 exp(-1) after a time constant; backward Euler is dt / (2 tau) of it too warm: 0.018 K.
TEST(ThermalNetwork, OneBodyCoolsExponentially) {
  EXPECT_NEAR(after(one_body(), 0.1, 1000, degC({100.0}))[0], 100.0 * std::exp(-1.0), 0.02);
}

TEST(ThermalNetwork, AnyStepIsStable) {
  const double temperature_degC = after(one_body(), 1e6, 3, degC({100.0}))[0];
  EXPECT_GE(temperature_degC, 0.0);
  EXPECT_LT(temperature_degC, 1e-9);
}

// A rod between 0 and 100 degC in five cells, 2 W/K from middle to middle and 4 W/K over the half cells at its ends:
// the middles are at 10, 30, 50, 70 and 90 % of the way.
TEST(ThermalNetwork, RodInSteadyStateIsLinear) {
  Network rod{Eigen::VectorXd::Ones(5), {}, {{0, 0, 4.0}, {4, 1, 4.0}}};
  for (Eigen::Index i = 0; i < 4; ++i) rod.links.push_back({i, i + 1, 2.0});
  const ImplicitStep forever(rod, kForever_s, none, Eigen::VectorXd::Zero(5));
  const Eigen::VectorXd middles = forever.next(Eigen::VectorXd::Zero(5), degC({0.0, 100.0}), none).temperature_degC;
  for (Eigen::Index i = 0; i < 5; ++i) EXPECT_NEAR(middles[i], 10.0 + 20.0 * static_cast<double>(i), 1e-10);
  // 40 W go in at one end and out at the other.
  const Eigen::VectorXd given = given_W(rod, middles, degC({0.0, 100.0}));
  EXPECT_NEAR(given[0], 40.0, 1e-9);
  EXPECT_NEAR(given[1], -40.0, 1e-9);
}

// 100 W - 2 W/K T in, 10 W/K T out: 100 / 12.
TEST(ThermalNetwork, HeatThatFallsWithTemperature) {
  const Heat falling = [](const Eigen::VectorXd& T) -> Eigen::VectorXd { return (100.0 - 2.0 * T.array()).matrix(); };
  EXPECT_NEAR(after(one_body(), kForever_s, 1, degC({0.0}), falling)[0], 100.0 / 12.0, 1e-9);
}

// Far from a straight line, with the slope of another temperature: 1000 exp(-T / 10) = 10 T at T = 31.4...
TEST(ThermalNetwork, HeatIsThatOfTheEndOfTheStep) {
  const Heat falling = [](const Eigen::VectorXd& T) -> Eigen::VectorXd {
    return (1000.0 * (-T.array() / 10.0).exp()).matrix();
  };
  const ImplicitStep forever(one_body(), kForever_s, falling, degC({10.0}));
  const StepResult steady = forever.next(degC({10.0}), degC({0.0}), falling);
  EXPECT_NEAR(falling(steady.temperature_degC)[0], 10.0 * steady.temperature_degC[0], 1e-6);
  EXPECT_NEAR(steady.heat_W[0], 10.0 * steady.temperature_degC[0], 1e-9);
}

// Stored = in - out over one step, whatever its length.
TEST(ThermalNetwork, StepConservesEnergy) {
  const Network two{degC({500.0, 2000.0}), {{0, 1, 3.0}}, {{1, 0, 7.0}}};
  const Heat heat = [](const Eigen::VectorXd& T) { return degC({50.0 - T[0], 0.0}); };
  const Eigen::VectorXd start = degC({20.0, 35.0});
  for (const double step_s : {1.0, 600.0}) {
    const StepResult end = ImplicitStep(two, step_s, heat, start).next(start, degC({18.0}), heat);
    const double stored_J = two.capacity_J_per_K.dot(end.temperature_degC - start);
    const double given_J = given_W(two, end.temperature_degC, degC({18.0}))[0] * step_s;
    EXPECT_NEAR(stored_J, end.heat_W.sum() * step_s - given_J, 1e-8) << step_s;
  }
}

}  // namespace
}  // namespace ballbar::thermal

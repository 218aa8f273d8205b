// Bodies that store heat, conductances between them and to surroundings, and one step of time:
//
//   C_i dT_i/dt = sum_j G_ij (T_j - T_i) + sum_b G_ib (T_b - T_i) + q_i(T_i)
//
// in backward Euler: every term on the right at the end of the step. No length of step makes it unstable, a step of
// any length conserves energy, and its steady state is exact; its error in time is of first order. A heat that depends
// on its own node's temperature (friction, by the lubricant's viscosity) is found by repetition, the matrix being
// factored once with its slope: chord iteration, to 1e-9 K.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <functional>
#include <vector>

namespace ballbar::thermal {

struct Link {
  Eigen::Index a = 0, b = 0;  // nodes
  double W_per_K = 0.0;
};

struct Outlet {
  Eigen::Index node = 0;
  Eigen::Index surroundings = 0;  // which of the temperatures that are given
  double W_per_K = 0.0;
};

struct Network {
  Eigen::VectorXd capacity_J_per_K;  // n nodes, > 0
  std::vector<Link> links;
  std::vector<Outlet> outlets;  // enough that every node reaches one
};

// n watts of n temperatures: q_i depends on T_i alone and does not rise with it.
using Heat = std::function<Eigen::VectorXd(const Eigen::VectorXd& temperature_degC)>;

struct StepResult {
  Eigen::VectorXd temperature_degC;
  Eigen::VectorXd heat_W;  // as the balance of the step used it
  int repetitions = 0;
};

// The network's matrix, factored for one length of step and the heat's slopes at one temperature. step_s may be
// infinite: `next` is then the steady state.
class ImplicitStep {
 public:
  ImplicitStep(const Network& network, double step_s, const Heat& heat, const Eigen::VectorXd& temperature_degC);

  // surroundings_degC: at the end of the step.
  StepResult next(const Eigen::VectorXd& temperature_degC, const Eigen::VectorXd& surroundings_degC,
                  const Heat& heat) const;

 private:
  Eigen::VectorXd stored_W_per_K_;  // C / dt
  std::vector<Outlet> outlets_;
  Eigen::VectorXd slope_W_per_K_;  // -dq/dT
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factored_;
};

// Heat that left through the outlets to each of the surroundings, W.
Eigen::VectorXd given_W(const Network& network, const Eigen::VectorXd& temperature_degC,
                        const Eigen::VectorXd& surroundings_degC);

}  // namespace ballbar::thermal

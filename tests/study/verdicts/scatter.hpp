// Noise of the target with a memory, drawn and taken off again by the study's own code.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "chance.hpp"

namespace ballbar::verdicts {

// An Ornstein-Uhlenbeck process, white noise beside it, rounded last.
struct Scatter {
  double sigma_um = 1.0;
  double time_constant_s = 700.0;
  double white_um = 0.05;
  double resolution_um = 0.01;
  bool heavy = false;  // innovations of the process: Student's t with four degrees of freedom
};

std::vector<double> drawn(const Scatter& scatter, const std::vector<double>& time_s, Chance& chance);
double rounded(double value, double step);

// Columns whitened: what a Kalman filter of that noise finds new in each row, over its sigma. n by as many.
Eigen::MatrixXd whitened(const Eigen::MatrixXd& columns, const std::vector<double>& time_s, const Scatter& scatter);

// Of a signal, whitened: what the columns of a model, whitened likewise, cannot make.
Eigen::VectorXd surviving(const Eigen::VectorXd& signal, const Eigen::MatrixXd& model);

}  // namespace ballbar::verdicts

// Reversal spikes, each by what stands at its own reversal.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "machine_errors/error_fit.hpp"

namespace ballbar {

// The columns of some spikes, the effects they are of (places among the columns), and each column's filter: with s a
// unit of the spike and V the noise in the rows up to 9 deg after its own reversals, V^-1 s. What a rest e shows of it
// is f' e / f' s. Those before a reversal would tell more of it against the noise, and less against the step of the
// play.
struct Spikes {
  ErrorColumns columns;
  std::vector<FittedEffect> effects;
  Eigen::MatrixXd filters;  // rows by columns
};

// left: what all other errors leave of the rows; it tells the widths. Reversals that no recording passes have none.
Spikes spikes_in(const std::vector<const Effect*>& effects, const ErrorRows& rows, const Eigen::VectorXd& left,
                 const Noise& noise);

}  // namespace ballbar

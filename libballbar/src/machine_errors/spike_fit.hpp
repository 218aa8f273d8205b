// Reversal spikes, each by what stands at its own reversal.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "machine_errors/error_fit.hpp"
#include "machine_errors/error_rows.hpp"

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

// The step of the play of an axis: its effect, with columns for some of its gains, and the values of these.
struct PlayStep {
  const Effect* effect = nullptr;
  std::vector<std::size_t> gains;
  Eigen::VectorXd values;
};

inline constexpr double kLeastSpikeEvidence = 10.0;  // from which on a spike is there

// Over which angle the play is taken up, and whether a spike is there beside a step of any width.
struct StepWidth {
  double width_deg = 0.0;
  double spike_evidence = 0.0;  // 2 ln of the Bayes factor of the spike
};

// left: what all others leave of the rows, with a step of no width.
StepWidth step_width(const PlayStep& step, const Effect& spike, const ErrorRows& rows, const Eigen::VectorXd& left,
                     const Noise& noise);

// Rows near a reversal: the form of a spike is never quite that of the model, and what is left there is no noise.

// Rows beyond the reach of a reversal, two of a recording joined to one, with the means of columns: what the noise is
// learnt from.
struct QuietRows {
  ErrorRows rows;
  Eigen::MatrixXd columns;
};
QuietRows quiet_rows(const ErrorRows& rows, const Eigen::MatrixXd& columns);

// By how much the readings within the reach of each reversal scatter more than those of none, a factor for each row; 1
// where that is not clear. Readings up to 1.5 deg after a reversal are left out: they are single ones.
Eigen::VectorXd excess_of(const ErrorRows& rows, const Eigen::VectorXd& residual);

}  // namespace ballbar

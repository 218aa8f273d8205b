// What the readings within 9 deg after the reversals of an axis show: the width of its step of play, and its spikes.
//
// With s a unit of a spike and V the noise of these rows, the rest e of all other errors shows f' e / f' s of it,
// f = V^-1 s. Rows before a reversal would tell more of it against the noise, and less against the step of the play.
//
// The step has a width of 0 to 1.5 deg, of the highest likelihood. A spike is needed where 2 ln of its Bayes factor
// beside a step of any width, or one that settles exponentially, is at least 10: heights N(0, 3 um), widths of equal
// prior probability.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ballbar/noise/noise.hpp"
#include "machine_errors/error_design.hpp"

namespace ballbar {

// The spikes of one effect. left: what all other errors leave of the rows; it tells the width.
EffectDesign spike_design(const Effect& spike, const ErrorRows& rows, const Eigen::VectorXd& left, const Noise& noise);

// The step of an axis' play: its effect, some of its gains and their values.
struct PlayStep {
  const Effect* effect = nullptr;
  std::vector<std::size_t> gains;
  Eigen::VectorXd values;
};

struct StepWidth {
  double width_deg = 0.0;
  bool needs_spike = false;
};

// left: what all others leave of the rows, with a step of no width.
StepWidth step_width(const PlayStep& step, const Effect& spike, const ErrorRows& rows, const Eigen::VectorXd& left,
                     const Noise& noise);

}  // namespace ballbar

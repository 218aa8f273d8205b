// What an effect adds at some of the rows it is evaluated on, and its slopes there.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

struct EffectAt {
  Eigen::VectorXd values;  // n
  Eigen::MatrixXd slopes;  // n by all parameters

  // Those by its gains: what a unit of each adds.
  Eigen::MatrixXd gains(const Effect& effect) const;
};
EffectAt effect_at(const Effect& effect, const EffectRows& inputs, const std::vector<double>& parameters,
                   const std::vector<std::size_t>& rows);

}  // namespace ballbar

// The values and derivatives of an effect at selected rows.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

struct EffectAt {
  Eigen::VectorXd values;  // n
  Eigen::MatrixXd slopes;  // n by all parameters

  // The derivatives by the gains: the curves of unit gains.
  Eigen::MatrixXd gains(const Effect& effect) const;
};
EffectAt effect_at(const Effect& effect, const EffectRows& inputs, const std::vector<double>& parameters,
                   const std::vector<std::size_t>& rows);

}  // namespace ballbar

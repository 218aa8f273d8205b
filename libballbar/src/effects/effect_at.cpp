#include "effects/effect_at.hpp"

namespace ballbar {

Eigen::MatrixXd EffectAt::gains(const Effect& effect) const {
  std::vector<Eigen::Index> columns;
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    if (effect.parameters[k].kind == ParameterKind::gain) columns.push_back(static_cast<Eigen::Index>(k));
  }
  return slopes(Eigen::all, columns);
}

EffectAt effect_at(const Effect& effect, const EffectRows& inputs, const std::vector<double>& parameters,
                   const std::vector<std::size_t>& rows) {
  const std::size_t count = effect.parameters.size();
  std::vector<double> values(inputs.time_s.size()), slopes(inputs.time_s.size() * count);
  effect.evaluate(inputs, parameters.data(), values.data(), slopes.data());
  EffectAt result;
  result.values.resize(static_cast<Eigen::Index>(rows.size()));
  result.slopes.resize(result.values.size(), static_cast<Eigen::Index>(count));
  for (Eigen::Index i = 0; i < result.values.size(); ++i) {
    const std::size_t row = rows[static_cast<std::size_t>(i)];
    result.values[i] = values[row];
    for (std::size_t k = 0; k < count; ++k) result.slopes(i, static_cast<Eigen::Index>(k)) = slopes[row * count + k];
  }
  return result;
}

}  // namespace ballbar

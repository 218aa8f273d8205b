#include <algorithm>
#include <cmath>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/revision/revision.hpp"
#include "diagnosis/verdict/member_tests.hpp"
#include "fit/machine_error_fit.hpp"
#include "revision/effect_test_parts.hpp"

namespace ballbar {

LedgerRow row_of(const Fit& fit, const Model& model, const Series& data, std::size_t target) {
  LedgerRow row;
  row.level = model.level;
  row.target = fit.target;
  row.parameters = static_cast<std::size_t>(
      std::count_if(fit.parameters.begin(), fit.parameters.end(),
                    [](const FittedParameter& parameter) { return parameter.state != ParameterState::held; }));
  row.rmse_um = fit.rmse_um;
  if (!fit.floor.source.empty() && fit.floor.rms_um > 0.0) row.times_floor = fit.rmse_um / fit.floor.rms_um;
  row.held_out_um = held_out_um(model, data, target);
  return row;
}

LedgerRow row_of(const Model& model, const Series& data, std::size_t target) {
  if (is_of_machine_errors(model, data)) return machine_error_row(model, data, target);
  return row_of(fit(model, data, target), model, data, target);
}

// Thresholds of 2 ln B are whole multiples of the least one, those of chi^2 are quantiles or not known.
bool is_of_axes(const LedgerRow& row) {
  const bool is_of_2_ln_B = std::remainder(row.threshold, kLeastLikelihoodRatio) == 0.0;
  return row.level == Level::recording && std::isfinite(row.likelihood_ratio) && !is_of_2_ln_B;
}

}  // namespace ballbar

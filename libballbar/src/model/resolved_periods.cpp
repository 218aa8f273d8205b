#include "model/resolved_periods.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"

namespace ballbar {

double highest_Hz(std::span<const double> time_s) {
  const double step_s = median_step_s(time_s);
  return step_s > 0.0 ? 0.5 / step_s : std::numeric_limits<double>::infinity();
}

double frequency_Hz(const Parameter& parameter, double value) {
  if (parameter.shape_of == ShapeOf::period) return 1.0 / value;
  return parameter.unit == "Hz" ? value : 0.0;
}

double usual_period_s(const Effect& effect) {
  for (const Parameter& parameter : effect.parameters) {
    if (parameter.shape_of == ShapeOf::period) return parameter.start;
  }
  return 0.0;
}

bool is_resolved(const Effect& effect, double highest_Hz) {
  const double period_s = usual_period_s(effect);
  return !(period_s > 0.0) || period_s * highest_Hz >= 1.0;
}

Term with_resolved_periods(Term term, double highest_Hz) {
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    const Parameter& parameter = term.effect->parameters[k];
    Setting& setting = term.settings[k];
    if (parameter.kind == ParameterKind::gain || setting.held) continue;
    Setting within = setting;
    if (parameter.shape_of == ShapeOf::period) {
      within.lower = std::max(within.lower, 1.0 / highest_Hz);
    } else if (frequency_Hz(parameter, setting.start) > 0.0) {
      within.upper = std::min(within.upper, highest_Hz);
    }
    if (!(within.lower < within.upper)) continue;
    within.start = std::clamp(within.start, within.lower, within.upper);
    if (setting.stated && within.start != setting.start) continue;
    setting = within;
  }
  return term;
}

Model with_resolved_periods(Model model, double highest_Hz) {
  for (Term& term : model.terms) term = with_resolved_periods(std::move(term), highest_Hz);
  return model;
}

}  // namespace ballbar

#include "diagnose/doubt_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {

Message message_of(Doubt doubt, const Effect& effect) {
  const bool of_recordings = effect.level == Level::recording;
  switch (doubt) {
    case Doubt::time_alone:
      return messages::doubt_time_alone();
    case Doubt::gain_differs:
      return of_recordings ? messages::doubt_gain_differs_recordings() : messages::doubt_gain_differs_cycles();
    case Doubt::not_predictive:
      return of_recordings ? messages::doubt_not_predictive_recordings() : messages::doubt_not_predictive_cycles();
    case Doubt::weak_evidence:
      return messages::doubt_weak_evidence();
    case Doubt::uncertain_size:
      return messages::doubt_uncertain_size(fmt::format("{:g}", kLeastSigmas));
    case Doubt::open_clock:
      return messages::doubt_open_clock();
    case Doubt::forgotten_change:
      return messages::doubt_forgotten_change();
    case Doubt::warm_start:
      return messages::doubt_warm_start();
    case Doubt::switched_input:
      return messages::doubt_switched_input();
    case Doubt::drift_beside:
      return messages::doubt_drift_beside();
    case Doubt::larger_drift:
      return messages::doubt_larger_drift();
    case Doubt::in_the_model:
      return messages::doubt_in_the_model();
    case Doubt::not_shown:
      return messages::doubt_not_shown();
    case Doubt::not_significant:
      break;
  }
  return messages::doubt_not_significant();
}

std::vector<Paragraph> doubts_of(const Candidate& candidate) {
  std::vector<Paragraph> doubts;
  doubts.reserve(candidate.doubts.size());
  for (const Doubt doubt : candidate.doubts) doubts.emplace_back(message_of(doubt, *candidate.bound.effect));
  return doubts;
}

Paragraph coefficient_of(const Candidate& candidate) {
  const auto gain =
      std::find_if(candidate.parameters.begin(), candidate.parameters.end(),
                   [](const FittedParameter& one) { return one.unit == "um/K" && one.kind == ParameterKind::gain; });
  if (gain == candidate.parameters.end() || gain->value == 0.0 || !std::isfinite(gain->sigma)) return {};
  return messages::coefficient(with_sigma(gain->value, gain->sigma, decimals_showing(2, gain->sigma)),
                               fmt::format("{:.2g}", candidate.amplitude_um / std::abs(gain->value)));
}

}  // namespace ballbar

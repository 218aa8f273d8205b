#include "diagnose/doubt_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/internal/number_text.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {

std::string text_of(Doubt doubt, const Effect& effect) {
  const bool of_recordings = effect.level == Level::recording;
  switch (doubt) {
    case Doubt::time_alone:
      return "it depends on time alone, as any slow drift does";
    case Doubt::gain_differs:
      return of_recordings ? "its gain differs from recording to recording" : "its gain differs from cycle to cycle";
    case Doubt::not_predictive:
      return of_recordings ? "it does not predict left-out recordings better"
                           : "it does not predict left-out cycles better";
    case Doubt::weak_evidence:
      return "the evidence for it is weak";
    case Doubt::forgotten_change:
      return "a change that the noise forgets explains nearly as much";
    case Doubt::drift_beside:
      return "beside a slow drift without a cause its form is open";
    case Doubt::larger_drift:
      return "a slow drift without a cause is larger";
    case Doubt::in_the_model:
      return "the model can already produce what it adds";
    case Doubt::not_shown:
      return "these readings do not show it";
    case Doubt::not_significant:
      break;
  }
  return "it is not significant beside the other errors of the axes";
}

std::vector<std::string> doubt_texts(const Candidate& candidate) {
  std::vector<std::string> texts;
  texts.reserve(candidate.doubts.size());
  for (const Doubt doubt : candidate.doubts) texts.push_back(text_of(doubt, *candidate.bound.effect));
  return texts;
}

std::string coefficient_text(const Candidate& candidate) {
  const auto gain =
      std::find_if(candidate.parameters.begin(), candidate.parameters.end(),
                   [](const FittedParameter& one) { return one.unit == "um/K" && one.kind == ParameterKind::gain; });
  if (gain == candidate.parameters.end() || gain->value == 0.0 || !std::isfinite(gain->sigma)) return "";
  return fmt::format("{} um/K, over {:.2g} K ", with_sigma(gain->value, gain->sigma, decimals_showing(2, gain->sigma)),
                     candidate.amplitude_um / std::abs(gain->value));
}

}  // namespace ballbar

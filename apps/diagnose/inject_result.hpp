// What `could --json` prints of one effect.
#pragma once

#include <string>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/formats/results/diagnosis_results.hpp"
#include "ballbar/internal/diagnosis/injection/injection.hpp"

namespace ballbar {

struct Sighting {
  Verdict verdict = Verdict::nothing;
  Sight sight = Sight::undetected;
};

template <>
inline constexpr auto kResult<Sighting> = ResultType(
    "Sighting", "What a diagnosis makes of an effect that is there.",
    Field{"verdict", &Sighting::verdict, "of the diagnosis"},
    Field{"seen", &Sighting::sight, "named, probable, in the reported set, driver, candidate, unexplained, not seen"});

template <>
inline constexpr auto kResult<DetectionLimit> =
    ResultType("SmallestSeen", "From which amplitude on an effect is seen.",
               Field{"not_seen_um", &DetectionLimit::undetected_um, "the largest that was tried and not seen"},
               Field{"seen_um", &DetectionLimit::detected_um, "the smallest that was seen; null: none"},
               Field{"diagnoses", &DetectionLimit::diagnoses, "that were made"});

// An effect added to data, with the diagnoses before and after.
struct Injected {
  Injection injection;
  double amplitude_um = 0.0;
  Fit base;        // of the model, without the effect
  double d = 0.0;  // of this amplitude, with the noise of the fit
  Diagnosis without, with;
  DetectionLimit smallest;

  double amplitude_of_um(double other_d) const { return other_d / d * amplitude_um; }
  Sighting sighting(const Diagnosis& diagnosis) const {
    return {diagnosis.verdict, sight_of(diagnosis, injection.bound)};
  }
};
std::string answer_text(const Injected& result);  // whole sentences
TableOf<double> shapes_of(const Injection& injection);

template <>
inline constexpr auto kResult<Injected> = ResultType(
    "Injected", "An effect put into data, and whether it is seen.",
    Field{"target", in(&Injected::without, &Diagnosis::target), "column that it is added to"},
    fields_of(in(&Injected::injection, &Injection::bound), kResult<BoundEffect>.fields),
    Field{"shapes", in(&Injected::injection, &shapes_of), "of the effect"},
    Field{"amplitude_um", &Injected::amplitude_um, "largest less smallest of what was added"},
    Field{"d", &Injected::d, "of that, beside the noise of the model's residual"},
    Field{"detectable_um", [](const Injected& of) { return of.amplitude_of_um(kDetectable); }, "amplitude of d = 5"},
    Field{"identifiable_um", [](const Injected& of) { return of.amplitude_of_um(kIdentifiable); },
          "amplitude of d = 7.5"},
    Field{"without", [](const Injected& of) { return of.sighting(of.without); }, "as measured"},
    Field{"with", [](const Injected& of) { return of.sighting(of.with); }, "with it"},
    Field{"answer", [](const Injected& of) { return answer_text(of); }, "what it says in plain words"},
    Field{"smallest", &Injected::smallest, "amplitude that is seen"});

}  // namespace ballbar

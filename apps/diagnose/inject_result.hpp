// What `could --json` prints of one effect.
#pragma once

#include <string>

#include "ballbar/diagnosis/injection/injection.hpp"
#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/formats/results/diagnosis_results.hpp"

namespace ballbar {

struct Sighting {
  Verdict verdict = Verdict::nothing;
  Sight sight = Sight::undetected;
};

template <>
struct ResultType<Sighting> {
  static constexpr std::string_view name = "Sighting";
  static constexpr std::string_view meaning = "What a diagnosis makes of an effect that is there.";
  static constexpr std::tuple fields{
      Field{"verdict", &Sighting::verdict, "of the diagnosis"},
      Field{"seen", &Sighting::sight,
            "named, probable, in the reported set, driver, candidate, unexplained, not seen"}};
};

template <>
struct ResultType<DetectionLimit> {
  static constexpr std::string_view name = "SmallestSeen";
  static constexpr std::string_view meaning = "From which amplitude on an effect is seen.";
  static constexpr std::tuple fields{
      Field{"not_seen_um", &DetectionLimit::undetected_um, "the largest that was tried and not seen"},
      Field{"seen_um", &DetectionLimit::detected_um, "the smallest that was seen; null: none"},
      Field{"diagnoses", &DetectionLimit::diagnoses, "that were made"}};
};

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
struct ResultType<Injected> {
  using Of = const Injected&;
  static constexpr std::string_view name = "Injected";
  static constexpr std::string_view meaning = "An effect put into data, and whether it is seen.";
  static constexpr std::tuple fields = std::tuple_cat(
      std::tuple{Field{"target", [](Of of) { return of.without.target; }, "column that it is added to"}},
      fields_through([](Of of) -> const BoundEffect& { return of.injection.bound; }, ResultType<BoundEffect>::fields),
      std::tuple{
          Field{"shapes", [](Of of) { return shapes_of(of.injection); }, "of the effect"},
          Field{"amplitude_um", &Injected::amplitude_um, "largest less smallest of what was added"},
          Field{"d", &Injected::d, "of that, beside the noise of the model's residual"},
          Field{"detectable_um", [](Of of) { return of.amplitude_of_um(kDetectable); }, "amplitude of d = 5"},
          Field{"identifiable_um", [](Of of) { return of.amplitude_of_um(kIdentifiable); }, "amplitude of d = 7.5"},
          Field{"without", [](Of of) { return of.sighting(of.without); }, "as measured"},
          Field{"with", [](Of of) { return of.sighting(of.with); }, "with it"},
          Field{"answer", [](Of of) { return answer_text(of); }, "what it says in plain words"},
          Field{"smallest", &Injected::smallest, "amplitude that is seen"}});
};

}  // namespace ballbar

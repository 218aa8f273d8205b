// What `could --json` prints of one effect.
#pragma once

#include <string>

#include "ballbar/diagnosis/injection/injection.hpp"
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

struct InjectedResult {
  std::string target;
  BoundEffect bound;
  TableOf<double> shapes;
  double amplitude_um = 0.0, d = 0.0, detectable_um = 0.0, identifiable_um = 0.0;
  Sighting without, with;
  std::string answer;
  DetectionLimit smallest;
};

template <>
struct ResultType<InjectedResult> {
  static constexpr std::string_view name = "Injected";
  static constexpr std::string_view meaning = "An effect put into data, and whether it is seen.";
  static constexpr std::tuple fields = std::tuple_cat(
      std::tuple{Field{"target", &InjectedResult::target, "column that it is added to"}},
      fields_through(&InjectedResult::bound, ResultType<BoundEffect>::fields),
      std::tuple{Field{"shapes", &InjectedResult::shapes, "of the effect"},
                 Field{"amplitude_um", &InjectedResult::amplitude_um, "largest less smallest of what was added"},
                 Field{"d", &InjectedResult::d, "of that, beside the noise of the model's residual"},
                 Field{"detectable_um", &InjectedResult::detectable_um, "amplitude of d = 5"},
                 Field{"identifiable_um", &InjectedResult::identifiable_um, "amplitude of d = 7.5"},
                 Field{"without", &InjectedResult::without, "as measured"},
                 Field{"with", &InjectedResult::with, "with it"},
                 Field{"answer", &InjectedResult::answer, "what it says in plain words"},
                 Field{"smallest", &InjectedResult::smallest, "amplitude that is seen"}});
};

}  // namespace ballbar

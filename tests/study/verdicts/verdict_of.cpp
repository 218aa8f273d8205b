#include "verdict_of.hpp"

#include <array>
#include <chrono>
#include <cmath>

#include "diagnose/diagnosis_sentence.hpp"

namespace ballbar::verdicts {
namespace {

Member member_of(const BoundEffect& bound, double p = 0.0) { return {bound.effect->name, bound.columns, p}; }

std::vector<Member> members_of(const std::vector<BoundEffect>& bounds) {
  std::vector<Member> members;
  members.reserve(bounds.size());
  for (const BoundEffect& bound : bounds) members.push_back(member_of(bound));
  return members;
}

Word word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::named:
      return Word::named;
    case Verdict::probable:
      return Word::probable;
    case Verdict::driver:
      return Word::driver;
    case Verdict::equivalent:
      return Word::equivalent;
    case Verdict::unexplained:
      return Word::unexplained;
    case Verdict::untestable:
      return Word::untestable;
    case Verdict::nothing:
      break;
  }
  return Word::nothing;
}

}  // namespace

std::string_view name_of(Word word) {
  constexpr std::array<std::string_view, 7> kWords{"named",       "probable",   "driver", "equivalent",
                                                   "unexplained", "untestable", "nothing"};
  return kWords[static_cast<std::size_t>(word)];
}

Said verdict_of(const Made& made) {
  DiagnosisOptions options;
  options.search.without = made.without;
  const auto start = std::chrono::steady_clock::now();
  const Diagnosis found = diagnose(made.model, made.data, 0, options);
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Said said = said_of(found);
  said.took_s = took_s;
  return said;
}

Said said_of(const Diagnosis& found) {
  Said said;
  said.word = word_of(found.verdict);
  said.named = members_of(found.named);
  said.probable = members_of(found.probable);
  said.equivalent.reserve(found.equivalent.size());
  for (const std::vector<BoundEffect>& group : found.equivalent) said.equivalent.push_back(members_of(group));
  for (const EffectProbability& one : found.effects) said.effects.push_back(member_of(one.bound, one.p));
  for (const Driver& one : found.drivers) {
    if (one.is_clear) said.drivers.push_back({one.column, one.p});
  }
  for (const OwnValue& one : found.own) said.own.push_back({one.effect, one.parameter, one.held, one.fitted, one.p});
  said.p_nothing = found.p_nothing;
  said.p_discrepancy = found.p_discrepancy;
  said.sentence = text_of(sentence_of(found));
  for (const std::string& reason : texts_of(reasons_of(found))) said.sentence += " " + reason;
  for (const Candidate& candidate : found.candidates) {
    if (!candidate.in_best_set) continue;
    for (std::size_t k = 0; k < candidate.parameters.size(); ++k) {
      const FittedParameter& parameter = candidate.parameters[k];
      const Interval& interval = candidate.intervals[k];
      if (parameter.shape_of == ShapeOf::onset) said.onsets.push_back({member_of(candidate.bound), parameter.value});
      if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) continue;
      said.intervals.push_back(
          {member_of(candidate.bound), parameter.name, parameter.value, interval.low, interval.high});
    }
  }
  return said;
}

}  // namespace ballbar::verdicts

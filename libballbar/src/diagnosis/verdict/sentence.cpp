#include "diagnosis/verdict/sentence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ballbar {
namespace {

constexpr std::size_t kInASentence = 4;

const Candidate* candidate_of(const Diagnosis& d, const BoundEffect& bound) {
  const auto at =
      std::find_if(d.candidates.begin(), d.candidates.end(), [&](const Candidate& one) { return one.bound == bound; });
  return at == d.candidates.end() ? nullptr : &*at;
}

double p_of(const Diagnosis& d, const BoundEffect& bound) {
  const auto at = std::find_if(d.effects.begin(), d.effects.end(),
                               [&](const EffectProbability& one) { return one.bound == bound; });
  return at == d.effects.end() ? 0.0 : at->p;
}

// "expansion(T_room_degC), 3.2 um (P = 0.98)"
std::string effect_text(const Diagnosis& d, const BoundEffect& bound) {
  const Candidate* one = candidate_of(d, bound);
  const std::string size =
      one != nullptr && one->amplitude_um > 0.0 ? fmt::format(", {:.2g} um", one->amplitude_um) : "";
  return fmt::format("{}{} (P = {:.2f}){}", label_of(bound), size, p_of(d, bound),
                     one != nullptr && one->minor ? ", which is minor" : "");
}

std::string effects_text(const Diagnosis& d, const std::vector<BoundEffect>& bounds) {
  std::vector<std::string> texts;
  for (const BoundEffect& bound : bounds) texts.push_back(effect_text(d, bound));
  return fmt::format("{}", fmt::join(texts, " and "));
}

std::string group_text(const Diagnosis& d, const std::vector<BoundEffect>& group) {
  std::vector<std::string> texts;
  const std::size_t said = group.size() > kInASentence + 1 ? kInASentence : group.size();
  for (std::size_t k = 0; k < said; ++k)
    texts.push_back(fmt::format("{} (P = {:.2f})", label_of(group[k]), p_of(d, group[k])));
  if (said < group.size()) texts.push_back(fmt::format("one of {} more", group.size() - said));
  return fmt::format("{}", fmt::join(texts, ", or "));
}

std::string own_text(const Diagnosis& d, double least) {
  std::string text;
  for (const OwnValue& own : d.own) {
    if (own.p < least) continue;
    text += fmt::format("The {} of {} is {:.3g} ({:.3g} to {:.3g}), the model holds {:.3g} (P = {:.2f}). ",
                        own.parameter, own.effect, own.fitted, own.interval.low, own.interval.high, own.held, own.p);
  }
  return text;
}

std::string drivers_text(const Diagnosis& d) {
  std::vector<std::string> texts;
  for (const Driver& driver : d.drivers) {
    if (driver.p >= kSureDriver) texts.push_back(fmt::format("{} (P = {:.2f})", driver.column, driver.p));
  }
  return fmt::format("{}", fmt::join(texts, " and "));
}

std::string open_text(const Diagnosis& d) {
  std::string text;
  for (const std::vector<BoundEffect>& group : d.equivalent)
    text += fmt::format("{}{}", text.empty() ? "" : "; and ", group_text(d, group));
  return text;
}

}  // namespace

std::string sentence_of(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::named: {
      std::string text = own_text(d, kNamed);
      if (!d.named.empty()) text += fmt::format("The model lacks {}. ", effects_text(d, d.named));
      if (!d.probable.empty()) text += fmt::format("Probably also {}. ", effects_text(d, d.probable));
      if (!d.equivalent.empty()) text += fmt::format("One of these as well: {}. ", open_text(d));
      text.pop_back();
      return text;
    }
    case Verdict::probable: {
      std::string text = own_text(d, kProbable);
      if (!d.probable.empty()) text += fmt::format("The model probably lacks {}. ", effects_text(d, d.probable));
      text.pop_back();
      return text;
    }
    case Verdict::driver:
      return fmt::format("{} drives what the model lacks; its form is open{}.", drivers_text(d),
                         d.equivalent.empty() ? "" : ": " + open_text(d));
    case Verdict::equivalent:
      return fmt::format("Something is missing, and the data cannot tell which of these it is: {}.", open_text(d));
    case Verdict::unexplained:
      return d.discrepancy_um > 0.0 && d.p_discrepancy >= kDiscrepancy
                 ? fmt::format(
                       "Something is left that no effect of the catalogue explains: a slow curve of {:.2g} um "
                       "(standard deviation).",
                       d.discrepancy_um)
                 : "Something is left that goes with time alone: no logged input drives it.";
    case Verdict::untestable:
      return "These data could not have shown a missing effect.";
    case Verdict::nothing:
      break;
  }
  std::string text = fmt::format("No effect is found (P of nothing = {:.2f}).", d.p_nothing);
  if (std::isfinite(d.smallest_um) && d.smallest.effect != nullptr) {
    text += fmt::format(" {} would have been from {:.2g} um.", label_of(d.smallest), d.smallest_um);
  }
  return text;
}

}  // namespace ballbar

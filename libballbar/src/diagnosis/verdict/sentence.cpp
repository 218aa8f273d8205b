#include "diagnosis/verdict/sentence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>
#include <vector>

#include "ballbar/number_text.hpp"
#include "diagnosis/thresholds.hpp"

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

// "; it fails most while warming"
std::string where_text(const Diagnosis& d) { return d.where.empty() ? "" : "; it fails most " + d.where; }

// "Free expansion with one temperature." within a sentence
std::string in_words(const Effect& effect) {
  std::string words = effect.explanation.summary;
  if (words.ends_with('.')) words.pop_back();
  if (words.size() > 1 && std::isupper(static_cast<unsigned char>(words[1])) == 0) {
    words[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(words[0])));
  }
  return words;
}

// ", time constant 51 min 39 s": the first fitted shape that is a time; else empty
std::string time_text(const Candidate& one) {
  constexpr std::string_view kUnit = "_s";
  for (const FittedParameter& parameter : one.parameters) {
    const bool found = parameter.state == ParameterState::free && std::isfinite(parameter.sigma);
    if (parameter.unit != "s" || !found || !is_of_curve(parameter.shape_of) || !parameter.name.ends_with(kUnit)) {
      continue;
    }
    std::string words = parameter.name.substr(0, parameter.name.size() - kUnit.size());
    std::replace(words.begin(), words.end(), '_', ' ');
    return fmt::format(", {} {}", words, duration_text(parameter.value));
  }
  return "";
}

// "step, a jump of -2.4 um at 9 h 24 min: very likely (over 99 %)"; empty: no onset
std::string jump_text(const Diagnosis& d, const Candidate& one) {
  const auto onset = std::find_if(one.parameters.begin(), one.parameters.end(), [](const FittedParameter& parameter) {
    return parameter.shape_of == ShapeOf::onset;
  });
  if (onset == one.parameters.end() || !one.bound.effect->time_only) return "";
  return fmt::format("{}, a jump of {} um at {}: {}", label_of(one.bound), size_text(one.parameters.front().value),
                     duration_text(onset->value), sure_text(p_of(d, one.bound)));
}

// "expansion(T_room_degC), free expansion with one temperature: 3.2 um, very likely (98 %)"
std::string effect_text(const Diagnosis& d, const BoundEffect& bound) {
  const Candidate* one = candidate_of(d, bound);
  if (one != nullptr) {
    if (std::string jump = jump_text(d, *one); !jump.empty()) return jump;
  }
  const bool sized = one != nullptr && one->amplitude_um > 0.0;
  return fmt::format("{}, {}: {}{}{}{}", label_of(bound), in_words(*bound.effect),
                     sized ? size_text(one->amplitude_um) + " um, " : "", one != nullptr && one->minor ? "minor, " : "",
                     sure_text(p_of(d, bound)), one != nullptr ? time_text(*one) : "");
}

std::string effects_text(const Diagnosis& d, const std::vector<BoundEffect>& bounds) {
  std::vector<std::string> texts;
  texts.reserve(bounds.size());
  for (const BoundEffect& bound : bounds) texts.push_back(effect_text(d, bound));
  return fmt::format("{}", fmt::join(texts, "; and "));
}

std::string group_text(const Diagnosis& d, const std::vector<BoundEffect>& group) {
  std::vector<std::string> texts;
  const std::size_t shown = group.size() > kInASentence + 1 ? kInASentence : group.size();
  for (std::size_t k = 0; k < shown; ++k)
    texts.push_back(fmt::format("{} ({})", label_of(group[k]), percent_text(p_of(d, group[k]))));
  if (shown < group.size()) texts.push_back(fmt::format("one of {} more", group.size() - shown));
  return fmt::format("{}", fmt::join(texts, ", or "));
}

std::string model_text(const Diagnosis& d, std::string_view the) {
  return d.target.empty() ? fmt::format("{} model", the) : fmt::format("{} model of {}", the, d.target);
}

// One sentence for each wrong held value.
std::string own_text(const Diagnosis& d, double least) {
  std::string text;
  for (const OwnValue& own : d.own) {
    if (own.p < least) continue;
    text += fmt::format("{} holds {:.3g} for the {} of {}, the data say {:.3g} ({:.3g} to {:.3g}): {}{}. ",
                        model_text(d, "The"), own.held, own.parameter, own.effect, own.fitted, own.interval.low,
                        own.interval.high, sure_text(own.p), text.empty() ? where_text(d) : "");
  }
  return text;
}

bool is_driver(const Driver& driver) { return driver.p >= kSureDriver; }

std::string drivers_text(const Diagnosis& d) {
  std::vector<std::string> names;
  double least = 1.0;
  for (const Driver& driver : d.drivers) {
    if (!is_driver(driver)) continue;
    names.push_back(driver.column);
    least = std::min(least, driver.p);
  }
  double size_um = 0.0;  // of the most probable set
  for (const Candidate& one : d.candidates) {
    const std::vector<std::string>& columns = one.bound.columns;
    const bool reads = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return std::find(columns.begin(), columns.end(), name) != columns.end();
    });
    if (reads && one.in_best_set) size_um = std::max(size_um, one.amplitude_um);
  }
  return fmt::format("{} {} something that {} lacks{}: {}{}; its form is open.", fmt::join(names, " and "),
                     names.size() == 1 ? "drives" : "drive", model_text(d, "the"),
                     size_um > 0.0 ? fmt::format(", about {} um", size_text(size_um)) : "", sure_text(least),
                     where_text(d));
}

std::string open_text(const Diagnosis& d) {
  std::string text;
  for (const std::vector<BoundEffect>& group : d.equivalent)
    text += fmt::format("{}{}", text.empty() ? "" : "; and ", group_text(d, group));
  return text;
}

// " What drives it: T_room_degC (64 %)."
std::string likely_drivers_text(const Diagnosis& d) {
  std::vector<std::string> likely;
  for (const Driver& driver : d.drivers)
    likely.push_back(fmt::format("{} ({})", driver.column, percent_text(driver.p)));
  return likely.empty() ? "" : fmt::format(" What drives it: {}.", fmt::join(likely, ", "));
}

std::string equivalent_text(const Diagnosis& d) {
  double size_um = 0.0;
  std::size_t effects = 0;
  for (const std::vector<BoundEffect>& group : d.equivalent) {
    effects += group.size();
    for (const BoundEffect& bound : group) {
      const Candidate* one = candidate_of(d, bound);
      if (one != nullptr && one->in_best_set) size_um = std::max(size_um, one->amplitude_um);
    }
  }
  return fmt::format("{} lacks something{}: {}{}; the data cannot tell {}. {}: {}.{}", model_text(d, "The"),
                     size_um > 0.0 ? fmt::format(" of about {} um", size_text(size_um)) : "",
                     sure_text(1.0 - d.p_nothing), where_text(d),
                     effects == 1 ? "for certain what it is" : fmt::format("which of {} effects it is", effects),
                     effects == 1 ? "In question is" : "It may be", open_text(d), likely_drivers_text(d));
}

// "linear_drift, about 10.6 um": an effect of time alone.
std::string drifts_text(const Diagnosis& d) {
  std::vector<std::string> texts;
  for (const Candidate& one : d.candidates) {
    if (one.in_best_set && one.bound.effect->time_only)
      texts.push_back(fmt::format("{}, about {} um", one.label, size_text(one.amplitude_um)));
  }
  return fmt::format("{}", fmt::join(texts, "; and "));
}

std::string unexplained_text(const Diagnosis& d) {
  const std::string drivers = likely_drivers_text(d);
  if (d.discrepancy_um > 0.0 && d.p_discrepancy >= kDiscrepancy) {
    return fmt::format("About {} um of slow drift of {} is unexplained: {}{}.{}", size_text(d.discrepancy_um),
                       d.target.empty() ? "the readings" : d.target, sure_text(d.p_discrepancy), where_text(d),
                       drivers.empty() ? " No logged column follows it: log another sensor, such as coolant, structure "
                                         "or room temperature."
                                       : drivers);
  }
  if (const std::string drifts = drifts_text(d); !drifts.empty() && drivers.empty()) {
    return fmt::format("{} lacks something that goes with time alone: {}{}. No logged column follows it.",
                       model_text(d, "The"), drifts, where_text(d));
  }
  const std::string candidate = !drivers.empty() || d.candidates.empty()
                                    ? drivers
                                    : fmt::format(" Best candidate: {}, {}, not proven.", d.candidates.front().label,
                                                  percent_text(d.candidates.front().p));
  return fmt::format("Something is probably still missing in {} ({}), of the {} um that it leaves{}.{}",
                     model_text(d, "the"), percent_text(1.0 - d.p_nothing), size_text(d.base.rmse_um), where_text(d),
                     candidate);
}

std::string missing_text(const Diagnosis& d, std::string_view verb, const std::vector<BoundEffect>& bounds) {
  return fmt::format("{} {} {}{}. ", model_text(d, "The"), verb, effects_text(d, bounds), where_text(d));
}

}  // namespace

std::string sentence_of(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::named: {
      std::string text = d.named.empty() ? "" : missing_text(d, "lacks", d.named);
      text += own_text(d, kNamed);
      if (!d.probable.empty()) text += fmt::format("Probably also {}. ", effects_text(d, d.probable));
      if (!d.equivalent.empty()) text += fmt::format("One of these as well: {}. ", open_text(d));
      text.pop_back();
      return text;
    }
    case Verdict::probable: {
      std::string text = d.probable.empty() ? "" : missing_text(d, "probably lacks", d.probable);
      text += own_text(d, kProbable);
      text.pop_back();
      return text;
    }
    case Verdict::driver:
      return drivers_text(d) + (d.equivalent.empty() ? "" : fmt::format(" It may be: {}.", open_text(d)));
    case Verdict::equivalent:
      return equivalent_text(d);
    case Verdict::unexplained:
      return unexplained_text(d);
    case Verdict::untestable:
      return "These data could not have shown a missing effect.";
    case Verdict::nothing:
      break;
  }
  std::string text = fmt::format("Nothing is missing in {} that these data could show: {}", model_text(d, "the"),
                                 sure_text(d.p_nothing));
  if (d.hidden_um > 0.0 && d.hidden.effect != nullptr) {
    text += fmt::format("; {} of up to {} um could hide", label_of(d.hidden), size_text(d.hidden_um));
  }
  return text + '.';
}

}  // namespace ballbar

#include "diagnose/diagnosis_sentence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/internal/number_text.hpp"
#include "diagnose/doubt_text.hpp"

namespace ballbar {
namespace {

constexpr double kImitated = 3.0;  // of the remaining error: a larger effect hides behind the model, not in the noise

double p_of(const Diagnosis& d, const BoundEffect& bound) {
  const auto at = std::find_if(d.effects.begin(), d.effects.end(),
                               [&](const EffectProbability& one) { return one.bound == bound; });
  return at == d.effects.end() ? 0.0 : at->p;
}

// An effect by itself may be larger than what all explain together: another one then cancels a part of it.
double said_um(const Diagnosis& d, double amplitude_um) {
  return d.explained_um > 0.0 ? std::min(amplitude_um, d.explained_um) : amplitude_um;
}

// " The model fails most while warming."
std::string where_text(const Diagnosis& d) {
  return d.where.empty() ? "" : fmt::format(" The model fails most {}.", d.where);
}

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

// "step, a jump of -2.4 um at 9 h 24 min (over 99 % sure)"; empty: it does not begin at a moment
std::string jump_text(const Diagnosis& d, const Candidate& one) {
  const auto onset = std::find_if(one.parameters.begin(), one.parameters.end(), [](const FittedParameter& parameter) {
    return parameter.shape_of == ShapeOf::onset;
  });
  if (onset == one.parameters.end() || !one.bound.effect->time_only) return "";
  return fmt::format("{}, a jump of {} um at {} ({})", label_of(one.bound), size_text(one.parameters.front().value),
                     duration_text(onset->value), sure_text(p_of(d, one.bound)));
}

// "expansion(T_room_degC), free expansion with one temperature: 3.2 um (98 % sure)"
std::string effect_text(const Diagnosis& d, const BoundEffect& bound) {
  const Candidate* one = candidate_of(d, bound);
  if (one != nullptr) {
    if (std::string jump = jump_text(d, *one); !jump.empty()) return jump;
  }
  const bool sized = one != nullptr && one->amplitude_um > 0.0;
  const double size_um = sized ? said_um(d, one->amplitude_um) : 0.0;
  const std::string sure = sure_text(p_of(d, bound)) + (one != nullptr && one->minor ? ", minor" : "");
  return fmt::format("{}, {}: {}{}", label_of(bound), in_words(*bound.effect),
                     sized ? fmt::format("{}{} um ({})", size_um < one->amplitude_um ? "" : coefficient_text(*one),
                                         size_text(size_um), sure)
                           : sure,
                     one != nullptr ? time_text(*one) : "");
}

// "the model of z_um"
std::string model_text(const Diagnosis& d) {
  return d.target.empty() ? "the model" : fmt::format("the model of {}", d.target);
}

// The first is said with what it is missing from, each other one in a sentence of its own.
std::string missing_text(const Diagnosis& d, std::string_view first, std::string_view other,
                         const std::vector<BoundEffect>& bounds) {
  std::string text;
  for (const BoundEffect& bound : bounds) {
    text += text.empty() ? fmt::format("{} from {}: ", first, model_text(d)) : fmt::format(" {}: ", other);
    text += effect_text(d, bound) + '.';
  }
  return text;
}

// "expansion(T1_degC) (60 %), possibly expansion(T2_degC) or one of 3 more": one probability, because those of
// alternatives need not add up to 1.
std::string group_text(const Diagnosis& d, const std::vector<BoundEffect>& group) {
  std::string text = fmt::format("{} ({})", label_of(group.front()), percent_text(p_of(d, group.front())));
  if (group.size() > 1) text += fmt::format(", possibly {}", label_of(group[1]));
  if (group.size() == 3) text += " or one more";
  if (group.size() > 3) text += fmt::format(" or one of {} more", group.size() - 2);
  return text;
}

// " A further effect is open as well: most likely A (65 %)." Of all groups behind the first.
std::string further_text(const Diagnosis& d) {
  if (d.equivalent.size() < 2) return "";
  std::string text = fmt::format(" A further effect is open as well: most likely {}.", group_text(d, d.equivalent[1]));
  const std::size_t more = d.equivalent.size() - 2;
  if (more > 0) text += fmt::format(" So {} {} more.", more == 1 ? "is" : "are", more);
  return text;
}

// " A further effect is open: most likely A (65 %)." Of all groups, beside what is named.
std::string open_text(const Diagnosis& d) {
  if (d.equivalent.empty()) return "";
  return fmt::format(" A further effect is open: most likely {}.{}", group_text(d, d.equivalent.front()),
                     further_text(d));
}

bool has_slow_drift(const Diagnosis& d) { return d.discrepancy_um > 0.0 && d.p_discrepancy >= kDiscrepancy; }

// "About ±4.2 um of slow drift has no cause among these columns (like settling, time constant 1 h 20 min)."
std::string slow_text(const Diagnosis& d) {
  std::string like;
  if (!d.discrepancy_like.empty()) {
    like = fmt::format(" (like {}{})", d.discrepancy_like,
                       d.discrepancy_parameter.empty()
                           ? ""
                           : fmt::format(", {} {}", d.discrepancy_parameter, duration_text(d.discrepancy_time_s)));
  }
  return fmt::format(
      "About ±{} um of slow drift{} has no cause among these columns{}. Log another sensor, such as the "
      "temperature of the coolant, the structure or the room.",
      size_text(d.discrepancy_um), d.target.empty() ? "" : fmt::format(" of {}", d.target), like);
}

// One sentence for each wrong held value.
std::string own_text(const Diagnosis& d, double least) {
  std::string text;
  if (has_slow_drift(d)) return text;
  for (const OwnValue& own : d.own) {
    if (own.p < least) continue;
    text += fmt::format("{}In {}, the {} of {} is held at {:.4g}, but the data say {:.4g} ({:.4g} to {:.4g}, {}).",
                        text.empty() ? "" : " ", model_text(d), own.parameter, own.effect, own.held, own.fitted,
                        own.interval.low, own.interval.high, sure_text(own.p));
  }
  return text;
}

bool is_driver(const Driver& driver) { return driver.p >= kSureDriver && driver.is_clear; }

std::string driver_text(const Diagnosis& d) {
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
    if (reads && one.in_best_set) size_um = std::max(size_um, said_um(d, one.amplitude_um));
  }
  const bool is_one = names.size() == 1;
  std::string text = fmt::format("{} {} {} that {} does not explain ({}). {} form is open", fmt::join(names, " and "),
                                 is_one ? "drives" : "drive",
                                 size_um > 0.0 ? fmt::format("about {} um", size_text(size_um)) : "a part",
                                 model_text(d), sure_text(least), is_one ? "Its" : "Their");
  if (!d.equivalent.empty()) text += fmt::format(": most likely {}", group_text(d, d.equivalent.front()));
  return text + '.' + further_text(d) + where_text(d);
}

// " Likely driver: T_room_degC (64 %)."
std::string likely_drivers_text(const Diagnosis& d) {
  constexpr std::size_t kMost = 2;
  std::vector<std::string> likely;
  for (const Driver& driver : d.drivers) {
    if (likely.size() < kMost) likely.push_back(fmt::format("{} ({})", driver.column, percent_text(driver.p)));
  }
  if (likely.empty()) return "";
  return fmt::format(" Likely driver{}: {}.", likely.size() == 1 ? "" : "s", fmt::join(likely, ", "));
}

std::string equivalent_text(const Diagnosis& d) {
  double size_um = 0.0;
  for (const std::vector<BoundEffect>& group : d.equivalent) {
    for (const BoundEffect& bound : group) {
      const Candidate* one = candidate_of(d, bound);
      if (one != nullptr && one->in_best_set) size_um = std::max(size_um, said_um(d, one->amplitude_um));
    }
  }
  const std::vector<BoundEffect>& first = d.equivalent.front();
  return fmt::format(
      "{} is missing from {} ({}). The data do not tell {}: most likely {}.{}{}{}",
      size_um > 0.0 ? fmt::format("Something of about {} um", size_text(size_um)) : "Something", model_text(d),
      sure_text(1.0 - d.p_nothing),
      first.size() == 1 ? "for certain what it is" : fmt::format("which of {} effects it is", first.size()),
      group_text(d, first), further_text(d), likely_drivers_text(d), where_text(d));
}

// "linear_drift, about 10.6 um": what depends on time alone.
std::string drifts_text(const Diagnosis& d) {
  std::vector<std::string> texts;
  for (const Candidate& one : d.candidates) {
    if (one.in_best_set && one.bound.effect->time_only)
      texts.push_back(fmt::format("{}, about {} um", one.label, size_text(said_um(d, one.amplitude_um))));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

// An effect, or another value of a held parameter.
std::string best_candidate_text(const Diagnosis& d) {
  std::string what;
  double p = 0.0;
  if (!d.candidates.empty()) {
    what = d.candidates.front().label;
    p = d.candidates.front().p;
  }
  for (const OwnValue& own : d.own) {
    if (own.p <= p) continue;
    what = fmt::format("another {} of {}", own.parameter, own.effect);
    p = own.p;
  }
  return what.empty() ? "" : fmt::format(" The best candidate, {} ({}), is not proven.", what, percent_text(p));
}

// What was not used is said first.
std::string not_used_text(const Diagnosis& d) {
  std::string text;
  for (const ColumnNotSearched& one : d.columns_not_searched)
    text += fmt::format("{} was not searched: {}. ", one.column, why_not_searched(one));
  for (const Saturated& one : d.saturated) {
    text += fmt::format(
        "{} stands at the end of its range for {} of the rows, as a saturated sensor does. These rows "
        "are set aside. ",
        one.column, percent_text(one.share));
  }
  if (d.set_aside > 0) {
    text += fmt::format("{} far from the others {} set aside. ",
                        d.set_aside == 1 ? "One reading" : fmt::format("{} readings", d.set_aside),
                        d.set_aside == 1 ? "is" : "are");
  }
  if (d.level_jumps > 0) {
    text += fmt::format("{} jumps {} times, by {} um: corrections of the control or of the probe, no drift. ",
                        d.target.empty() ? "The target" : d.target, d.level_jumps, size_text(d.level_jump_um));
  }
  return text;
}

std::string unexplained_text(const Diagnosis& d) {
  const std::string drivers = likely_drivers_text(d);
  if (has_slow_drift(d)) return slow_text(d) + drivers + where_text(d);
  if (d.p_nothing >= kNothing && d.level_jumps == 0) {
    return fmt::format(
        "The remaining error of {} is more than three times the stated sigma of its readings, and no logged column "
        "explains it. Either a cause was not logged, or the readings repeat worse than their sigma.",
        d.target.empty() ? "the target" : d.target);
  }
  if (d.level_jumps > 0) return "No effect is missing beside its jumps, as far as these data show." + where_text(d);
  if (const std::string drifts = drifts_text(d); !drifts.empty() && drivers.empty()) {
    return fmt::format("Something that depends on time alone is missing from {}: {}. No logged column follows it.{}",
                       model_text(d), drifts, where_text(d));
  }
  const std::string candidate = drivers.empty() ? best_candidate_text(d) : drivers;
  return fmt::format("Something is probably still missing from {} ({}). The remaining error is {} um RMS.{}{}",
                     model_text(d), percent_text(1.0 - d.p_nothing), size_text(d.base.rmse_um), candidate,
                     where_text(d));
}

std::string verdict_text(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::named: {
      std::string text = missing_text(d, "Missing", "Also missing", d.named);
      const std::string own = own_text(d, kNamed);
      if (!own.empty()) text += (text.empty() ? "" : " ") + own;
      for (const BoundEffect& bound : d.probable)
        text += fmt::format(" Probably also missing: {}.", effect_text(d, bound));
      return text + open_text(d) + where_text(d);
    }
    case Verdict::probable: {
      std::string text = missing_text(d, "Probably missing", "Probably also missing", d.probable);
      const std::string own = own_text(d, kProbable);
      if (!own.empty()) text += (text.empty() ? "" : " ") + own;
      return text + open_text(d) + where_text(d);
    }
    case Verdict::driver:
      return driver_text(d);
    case Verdict::equivalent:
      return equivalent_text(d);
    case Verdict::unexplained:
      return unexplained_text(d);
    case Verdict::untestable:
      return "These data could not have shown a missing effect.";
    case Verdict::nothing:
      break;
  }
  std::string text = fmt::format("Nothing further is missing from {} that these data could show ({}).", model_text(d),
                                 sure_text(d.p_nothing));
  if (d.hidden_um > 0.0 && d.hidden.effect != nullptr)
    text += fmt::format(" Up to {} um of {} could still be hidden{}.", size_text(d.hidden_um), label_of(d.hidden),
                        d.hidden_um > kImitated * d.base.rmse_um ? ", because the model imitates it" : "");
  return text;
}

}  // namespace

std::string sentence_of(const Diagnosis& d) {
  if (d.obstacle == Obstacle::still_readings) return "The readings do not change: there is nothing to explain.";
  const std::string text = not_used_text(d) + verdict_text(d);
  return d.verdict != Verdict::unexplained && has_slow_drift(d) ? text + " " + slow_text(d) : text;
}

std::string_view why_not_searched(const ColumnNotSearched& column) {
  return column.has_gaps ? "it has gaps" : "no effect reads it";
}

std::vector<std::string> reasons_of(const Diagnosis& d) {
  if (d.obstacle == Obstacle::too_few_values) return {"There are too few values to test anything more."};
  if (d.obstacle == Obstacle::no_effect) return {"No effect of the catalogue can be tested on these data."};
  std::vector<std::string> reasons;
  for (const Candidate& one : d.candidates) {
    if (!one.in_best_set) continue;
    if (one.other_form_likelier)
      reasons.push_back(fmt::format("{}: another form of the same column is more likely.", one.label));
    for (const GainByRun& gain : d.gains_by_run) {
      if (gain.effect == one.label) reasons.push_back(fmt::format("{}: its gain differs from run to run.", one.label));
    }
    for (const std::string& doubt : doubt_texts(one)) reasons.push_back(fmt::format("{}: {}.", one.label, doubt));
  }
  return reasons;
}

}  // namespace ballbar

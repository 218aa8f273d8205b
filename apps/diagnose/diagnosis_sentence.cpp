#include "diagnose/diagnosis_sentence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "diagnose/doubt_text.hpp"
#include "errors/quantity_text.hpp"
#include "model/column_fault_text.hpp"
#include "model/residual_sentences.hpp"

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

// "The model fails most while warming."
Paragraph where_sentence(const Diagnosis& d) {
  return d.where ? Paragraph(messages::fails_most(misfit_place(*d.where))) : Paragraph();
}

Message time_message(const std::string& parameter, double time_s) {
  const Message name = parameter == "time constant" ? messages::parameter_time_constant()
                       : parameter == "period"      ? messages::parameter_period()
                                                    : as_it_is(parameter);
  return messages::effect_time(name, duration_text(time_s));
}

// ", time constant 51 min 39 s": the first fitted shape that is a time; else empty
Paragraph time_of(const Candidate& one) {
  constexpr std::string_view kUnit = "_s";
  for (const FittedParameter& parameter : one.parameters) {
    const bool found = parameter.state == ParameterState::free && std::isfinite(parameter.sigma);
    if (parameter.unit != "s" || !found || !is_of_curve(parameter.shape_of) || !parameter.name.ends_with(kUnit)) {
      continue;
    }
    std::string words = parameter.name.substr(0, parameter.name.size() - kUnit.size());
    std::replace(words.begin(), words.end(), '_', ' ');
    return time_message(words, parameter.value);
  }
  return {};
}

// "step, a jump of -2.4 um at 9 h 24 min (over 99 % sure)"; empty: it does not begin at a moment
Paragraph jump_of(const Diagnosis& d, const Candidate& one) {
  const auto onset = std::find_if(one.parameters.begin(), one.parameters.end(), [](const FittedParameter& parameter) {
    return parameter.shape_of == ShapeOf::onset;
  });
  if (onset == one.parameters.end() || !one.bound.effect->time_only) return {};
  return messages::effect_jump(EffectLabel{label_of(one.bound)}, size_text(one.parameters.front().value),
                               duration_text(onset->value), sure_of(p_of(d, one.bound)));
}

// "expansion(T_room_degC), free expansion with one temperature: 3.2 um (98 % sure)"
Paragraph effect_of(const Diagnosis& d, const BoundEffect& bound) {
  const Candidate* one = candidate_of(d, bound);
  if (one != nullptr) {
    if (Paragraph jump = jump_of(d, *one); !jump.empty()) return jump;
  }
  const EffectLabel label{label_of(bound)};
  const Message what = effect_text(name_of(bound.effect->level), bound.effect->name, "summary",
                                   within_sentence(bound.effect->explanation.summary));
  const double p = p_of(d, bound);
  if (one == nullptr) return messages::effect_found_unsized(label, what, sure_of(p), Paragraph());
  const Message how_sure = one->minor ? messages::sure_minor(percent_of(p)) : sure_of(p);
  if (!(one->amplitude_um > 0.0)) return messages::effect_found_unsized(label, what, how_sure, time_of(*one));
  const double size_um = said_um(d, one->amplitude_um);
  return messages::effect_found(label, what, size_um < one->amplitude_um ? Paragraph() : coefficient_of(*one),
                                size_text(size_um), how_sure, time_of(*one));
}

// "the model of z_um"
Message model_of(const Diagnosis& d) {
  return d.target.empty() ? messages::the_model() : messages::the_model_of(d.target);
}

MessageValue target_of(const Diagnosis& d, const Message& otherwise) {
  return d.target.empty() ? MessageValue(otherwise) : MessageValue(d.target);
}

// "expansion(T1_degC) (60 %), possibly expansion(T2_degC) or one of 3 more": one probability, because those of
// alternatives need not add up to 1.
Message group_of(const Diagnosis& d, const std::vector<BoundEffect>& group) {
  Paragraph possibly, more;
  if (group.size() > 1) possibly = messages::group_possibly(EffectLabel{label_of(group[1])});
  if (group.size() == 3) more = messages::group_one_more();
  if (group.size() > 3) more = messages::group_more(group.size() - 2);
  return messages::group(EffectLabel{label_of(group.front())}, percent_of(p_of(d, group.front())), possibly, more);
}

// "A further effect is open as well: most likely A (65 %)." Of all groups behind the first.
Paragraph further_of(const Diagnosis& d) {
  if (d.equivalent.size() < 2) return {};
  Paragraph text = messages::further_open_as_well(group_of(d, d.equivalent[1]));
  const std::size_t more = d.equivalent.size() - 2;
  if (more > 0) text += messages::more_are_open(more);
  return text;
}

// "A further effect is open: most likely A (65 %)." Of all groups, beside what is named.
Paragraph open_of(const Diagnosis& d) {
  if (d.equivalent.empty()) return {};
  Paragraph text = messages::further_open(group_of(d, d.equivalent.front()));
  text += further_of(d);
  return text;
}

bool has_slow_drift(const Diagnosis& d) { return d.discrepancy_um > 0.0 && d.p_discrepancy >= kDiscrepancy; }

// "About ±4.2 um of slow drift has no cause among these columns (like settling, time constant 1 h 20 min)."
Paragraph slow_drift_of(const Diagnosis& d) {
  Paragraph like, time;
  if (!d.discrepancy_parameter.empty()) time = time_message(d.discrepancy_parameter, d.discrepancy_time_s);
  if (!d.discrepancy_like.empty()) like = messages::slow_drift_like(EffectLabel{d.discrepancy_like}, time);
  const std::string size = size_text(d.discrepancy_um);
  return d.target.empty() ? messages::slow_drift(size, like) : messages::slow_drift_of(size, d.target, like);
}

// One sentence for each wrong held value.
Paragraph held_values_of(const Diagnosis& d, double least) {
  Paragraph text;
  if (has_slow_drift(d)) return text;
  const auto digits = [](double value) { return fmt::format("{:.4g}", value); };
  for (const OwnValue& own : d.own) {
    if (own.p < least) continue;
    const std::string unit = own.unit == "1" ? "" : " " + own.unit;
    text += messages::held_value_wrong(model_of(d), own.parameter, EffectLabel{own.effect}, digits(own.held) + unit,
                                       digits(own.fitted) + unit, digits(own.interval.low), digits(own.interval.high),
                                       sure_of(own.p));
  }
  return text;
}

bool is_driver(const Driver& driver) { return driver.p >= kSureDriver && driver.is_clear; }

Paragraph driver_verdict(const Diagnosis& d) {
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
  Paragraph text = messages::driven(enumerated({names.begin(), names.end()}), names.size(),
                                    size_um > 0.0 ? messages::part_sized(size_text(size_um)) : messages::part(),
                                    model_of(d), sure_of(least));
  text += d.equivalent.empty() ? messages::form_open(names.size())
                               : messages::form_open_likely(names.size(), group_of(d, d.equivalent.front()));
  text += further_of(d);
  text += where_sentence(d);
  return text;
}

// "Likely driver: T_room_degC (64 %)."
Paragraph likely_drivers_of(const Diagnosis& d) {
  constexpr std::size_t kMost = 2;
  std::vector<MessageValue> likely;
  for (const Driver& driver : d.drivers) {
    if (likely.size() < kMost) likely.emplace_back(messages::column_with_p(driver.column, percent_of(driver.p)));
  }
  return likely.empty() ? Paragraph() : messages::likely_drivers(likely.size(), listed(likely));
}

Paragraph equivalent_verdict(const Diagnosis& d) {
  double size_um = 0.0;
  for (const std::vector<BoundEffect>& group : d.equivalent) {
    for (const BoundEffect& bound : group) {
      const Candidate* one = candidate_of(d, bound);
      if (one != nullptr && one->in_best_set) size_um = std::max(size_um, said_um(d, one->amplitude_um));
    }
  }
  const std::vector<BoundEffect>& first = d.equivalent.front();
  const Message how_sure = sure_of(1.0 - d.p_nothing);
  Paragraph text = size_um > 0.0 ? messages::something_missing_sized(size_text(size_um), model_of(d), how_sure)
                                 : messages::something_missing(model_of(d), how_sure);
  text += first.size() == 1 && p_of(d, first.front()) >= kNamed ? messages::not_certain_doubt(group_of(d, first))
          : first.size() == 1                                   ? messages::not_certain_what(group_of(d, first))
                              : messages::not_certain_which(first.size(), group_of(d, first));
  text += further_of(d);
  text += likely_drivers_of(d);
  text += where_sentence(d);
  return text;
}

// "linear_drift, about 10.6 um": what depends on time alone.
Paragraph drifts_of(const Diagnosis& d) {
  std::vector<MessageValue> drifts;
  for (const Candidate& one : d.candidates) {
    if (one.in_best_set && one.bound.effect->time_only)
      drifts.emplace_back(messages::effect_about(EffectLabel{one.label}, size_text(said_um(d, one.amplitude_um))));
  }
  return semicolon_list(drifts);
}

// An effect, or another value of a held parameter.
Paragraph best_candidate_of(const Diagnosis& d) {
  Paragraph text;
  double p = 0.0;
  if (!d.candidates.empty()) {
    p = d.candidates.front().p;
    text = messages::best_not_proven(EffectLabel{d.candidates.front().label}, percent_of(p));
  }
  for (const OwnValue& own : d.own) {
    if (own.p <= p) continue;
    p = own.p;
    text = messages::best_value_not_proven(own.parameter, EffectLabel{own.effect}, percent_of(p));
  }
  return text;
}

Paragraph unexplained_verdict(const Diagnosis& d) {
  Paragraph text;
  const Paragraph drivers = likely_drivers_of(d), drifts = drifts_of(d);
  if (has_slow_drift(d)) {
    text = slow_drift_of(d);
    text += messages::log_more();
    text += drivers;
  } else if (d.p_nothing >= kNothing && d.level_jumps == 0) {
    return messages::error_above_sigma(target_of(d, messages::the_target()));
  } else if (d.level_jumps > 0) {
    text = messages::jumps_alone();
  } else if (!drifts.empty() && drivers.empty()) {
    text = messages::time_alone_missing(model_of(d), drifts);
  } else {
    text = messages::still_missing(model_of(d), percent_of(1.0 - d.p_nothing), size_text(d.base.rmse_um));
    text += drivers.empty() ? best_candidate_of(d) : drivers;
  }
  text += where_sentence(d);
  return text;
}

// The first is said with what it is missing from, each other one in a sentence of its own; then wrong held values.
Paragraph missing_verdict(const Diagnosis& d) {
  const bool is_named = d.verdict == Verdict::named;
  Paragraph text;
  for (const BoundEffect& bound : is_named ? d.named : d.probable) {
    const Paragraph effect = effect_of(d, bound);
    if (text.empty()) {
      text += is_named ? messages::missing(model_of(d), effect) : messages::missing_probably(model_of(d), effect);
    } else {
      text += is_named ? messages::missing_also(effect) : messages::missing_probably_also(effect);
    }
  }
  text += held_values_of(d, is_named ? kNamed : kProbable);
  if (is_named) {
    for (const BoundEffect& bound : d.probable) text += messages::missing_probably_also(effect_of(d, bound));
  }
  text += open_of(d);
  text += where_sentence(d);
  return text;
}

Paragraph of_verdict(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::named:
    case Verdict::probable:
      return missing_verdict(d);
    case Verdict::driver:
      return driver_verdict(d);
    case Verdict::equivalent:
      return equivalent_verdict(d);
    case Verdict::unexplained:
      return unexplained_verdict(d);
    case Verdict::untestable:
      return messages::untestable();
    case Verdict::nothing:
      break;
  }
  Paragraph text = messages::nothing_missing(model_of(d), sure_of(d.p_nothing));
  if (d.hidden_um > 0.0 && d.hidden.effect != nullptr) {
    const EffectLabel hidden{label_of(d.hidden)};
    text += d.hidden_um > kImitated * d.base.rmse_um
                ? messages::could_be_hidden_imitated(size_text(d.hidden_um), hidden)
                : messages::could_be_hidden(size_text(d.hidden_um), hidden);
  }
  return text;
}

}  // namespace

std::vector<Paragraph> not_used_sentences(const Diagnosis& d) {
  std::vector<Paragraph> sentences;
  if (!d.has_clock) sentences.emplace_back(messages::no_clock());
  for (const ColumnNotSearched& one : d.columns_not_searched)
    sentences.emplace_back(messages::not_searched(one.column, why_not_searched(one)));
  for (const CoarseColumn& one : d.coarse_columns) {
    sentences.emplace_back(
        messages::coarse_column(one.column, fmt::format("{:.2g} {}", one.resolution, unit_of(one.column))));
  }
  for (const Saturated& one : d.saturated)
    sentences.emplace_back(one.is_stuck ? messages::stuck(one.column, percent_of(one.share))
                                        : messages::saturated(one.column, percent_of(one.share)));
  for (const SensorJump& one : d.sensor_jumps) sentences.emplace_back(sentence_of(one));
  if (d.set_aside == 1) sentences.emplace_back(messages::reading_set_aside());
  if (d.set_aside > 1) sentences.emplace_back(messages::readings_set_aside(d.set_aside));
  if (d.level_jumps > 0) {
    sentences.emplace_back(
        messages::target_jumps(target_of(d, messages::the_target_first()), d.level_jumps, size_text(d.level_jump_um)));
  }
  return sentences;
}

Paragraph verdict_sentences(const Diagnosis& d) {
  if (d.obstacle == Obstacle::still_readings) return messages::still_readings();
  Paragraph text = of_verdict(d);
  if (d.verdict == Verdict::unexplained || !has_slow_drift(d)) return text;
  text += slow_drift_of(d);
  text += messages::log_more();
  return text;
}

Paragraph slow_drift_beside(const Diagnosis& d) {
  if (!has_slow_drift(d)) return {};
  return d.verdict == Verdict::unexplained ? messages::log_more() : slow_drift_of(d);
}

Paragraph sentence_of(const Diagnosis& d) {
  Paragraph text;
  for (Paragraph& sentence : not_used_sentences(d)) text += std::move(sentence);
  text += verdict_sentences(d);
  return text;
}

Paragraph why_not_searched(const ColumnNotSearched& column) {
  if (column.is_words) return messages::column_of_words();
  return column.has_gaps ? messages::column_has_gaps() : messages::column_unread();
}

std::vector<Paragraph> reasons_of(const Diagnosis& d) {
  if (d.obstacle == Obstacle::too_few_values) return {messages::reason_too_few_values()};
  if (d.obstacle == Obstacle::no_effect) return {messages::reason_no_effect()};
  std::vector<Paragraph> reasons;
  for (const Candidate& one : d.candidates) {
    if (!one.in_best_set) continue;
    const auto add = [&](const MessageValue& why) {
      reasons.emplace_back(messages::reason_of_effect(EffectLabel{one.label}, why));
    };
    if (one.other_form_likelier) add(messages::reason_other_form());
    for (const GainByRun& gain : d.gains_by_run) {
      if (gain.effect == one.label) add(messages::reason_gain_by_run());
    }
    for (const Paragraph& doubt : doubts_of(one)) add(doubt);
  }
  return reasons;
}

}  // namespace ballbar

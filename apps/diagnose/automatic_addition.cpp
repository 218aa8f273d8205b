#include "diagnose/automatic_addition.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/circle/recording.hpp"
#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "diagnose/diagnosis_report.hpp"
#include "diagnose/diagnosis_sentence.hpp"
#include "diagnose/effect_test_text.hpp"
#include "diagnose/next_command.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostAdditions = 6;

std::string labels_of_added(const EffectTest& tried) {
  std::vector<std::string> names;
  for (const Candidate& one : tried.added) names.push_back(one.label);
  return text_of(enumerated(effects_of(names)));
}

std::string either_text(const std::vector<std::vector<BoundEffect>>& groups) {
  std::vector<std::string> texts;
  texts.reserve(groups.size());
  for (const std::vector<BoundEffect>& group : groups) {
    texts.push_back(labels(group, " or "));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

// Why the search goes no further.
std::string stop_text(const AutomaticAddition& how, const Diagnosis& diagnosis) {
  const std::vector<std::string> reasons = texts_of(reasons_of(diagnosis));
  const std::string why = reasons.empty() ? "" : fmt::format(" {}", fmt::join(reasons, " "));
  const std::string hint = text_of(next_hint(how.written, diagnosis));
  switch (diagnosis.verdict) {
    case Verdict::nothing:
      return diagnosis.hidden_um > 0.0
                 ? fmt::format("Stopped: no further effect is found. Up to {} um of {} could still be hidden.{}",
                               size_text(diagnosis.hidden_um), label_of(diagnosis.hidden), why)
                 : fmt::format("Stopped: no further effect is found.{}", why);
    case Verdict::named:
    case Verdict::probable:
      return fmt::format("Stopped. {}{}{}{}", text_of(sentence_of(diagnosis)), hint.empty() ? "" : " ", hint, why);
    case Verdict::driver:
      return fmt::format("Stopped. {}{}", text_of(sentence_of(diagnosis)), why);
    case Verdict::equivalent:
      return fmt::format("Stopped: an effect is missing, but the data do not tell which: {}.{}",
                         either_text(diagnosis.equivalent), why);
    case Verdict::unexplained:
      return fmt::format("Stopped: something is missing that no known effect explains.{}", why);
    default:
      return fmt::format("Stopped: these data cannot test any further effect.{}", why);
  }
}

// An input of the effect of which the recordings state no value; nullptr: none.
const Input* missing_input(const Effect& effect, const Series& trace) {
  for (const Input& input : effect.inputs) {
    const std::vector<double>& values = find_column(trace, trace_column(input.role))->values;
    if (std::none_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) return &input;
  }
  return nullptr;
}

// The errors of the axes that are significant, each a revision, first the one that leaves least. Returns why it
// stopped.
std::string add_errors(const AutomaticAddition& how, const ModelData& data, Additions& additions) {
  const MachineErrors found =
      with_source(how.model.data.front().name(), [&] { return machine_errors_of_trace(*data.series); });
  std::string not_added;
  for (const AddedError& one : found.one_by_one) {
    const std::vector<Term>& terms = additions.model.model().terms;
    const bool has =
        std::any_of(terms.begin(), terms.end(), [&](const Term& term) { return term.effect.get() == one.effect; });
    if (has) continue;
    if (one.group) {
      std::string names = name_of(found.groups[*one.group]);
      not_added += fmt::format(" Not added, since these readings cannot separate them: {}.", names);
      continue;
    }
    if (const Input* missing = missing_input(*one.effect, *data.series)) {
      not_added += fmt::format(" Not added, since the recordings state no {}: {}.", missing->role, one.effect->name);
      continue;
    }
    additions.model.add({term_of(one.effect->name, {}, Level::recording)});
    additions.effect_tests.push_back(additions.model.revise({.prune = how.prune}));
    additions.effect_tests.back().after.verdict = name_of(Verdict::named);
  }
  const double left_um = found.residual_rms_um;
  return found.left ? fmt::format(
                          "Stopped: no other error of the axes is significant. A wave of {} per turn remains that no "
                          "known effect explains.{}",
                          found.left->harmonic, not_added)
                    : fmt::format(
                          "Stopped: no other error of the axes is significant. With all errors, {:.2f} um RMS "
                          "remains.{}",
                          left_um, not_added);
}

// The same effect on the same columns; a step or a jump at the same time.
bool holds(const Model& model, const Term& term) {
  return std::any_of(model.terms.begin(), model.terms.end(), [&](const Term& one) {
    if (one.effect->name != term.effect->name || one.columns != term.columns) return false;
    for (std::size_t k = 0; k < one.settings.size(); ++k) {
      const bool is_onset = one.effect->parameters[k].shape_of == ShapeOf::onset;
      if (is_onset && one.settings[k].start != term.settings[k].start) return false;
    }
    return true;
  });
}

// Adds those of the terms that their test supports. Returns why there are none.
std::string add_supported(std::vector<Term> terms, RevisedModel& model) {
  std::string why;
  while (!terms.empty()) {
    model.add(terms);
    const EffectTest& tried = model.bench().added();
    if (tried.after.verdict != kNotSupported) return "";
    if (why.empty()) why = text_of(conclusion(tried));
    std::vector<Term> supported;
    for (std::size_t k = 0; k < terms.size(); ++k) {
      if (tried.added[k].doubts.empty()) supported.push_back(terms[k]);
    }
    model.take_back();
    terms = std::move(supported);
  }
  return why;
}

// Effects that diagnose() names, until it names none that the model has not, or those that their test does not support.
// Returns why it stopped. texts: of the model's file before each revision.
std::string add_named(const AutomaticAddition& how, Additions& additions, std::vector<std::string>& texts,
                      Verdict& verdict) {
  while (true) {
    show_progress(fmt::format("searching, {} revisions so far", additions.effect_tests.size()));
    const Diagnosis diagnosis =
        with_source(how.model.data.front().name(), [&] { return additions.model.bench().diagnosis(); });
    verdict = diagnosis.verdict;
    additions.drivers = diagnosis.drivers;
    if (diagnosis.named.empty()) return stop_text(how, diagnosis);
    // A second cycle beside one that is there would begin where that one does.
    Model with = additions.model.model();
    std::vector<Term> terms;
    for (const BoundEffect& bound : diagnosis.named) {
      Term term = as_diagnosed(bound, diagnosis);
      if (holds(with, term)) continue;
      with.terms.push_back(term);
      terms.push_back(std::move(term));
    }
    if (terms.empty()) return "Stopped: the effect that is named is in the model already.";
    if (const std::string why = add_supported(std::move(terms), additions.model); !why.empty()) {
      verdict = Verdict::unexplained;
      return fmt::format("Stopped, and not added. {}", why);
    }
    texts.push_back(additions.model.text());
    additions.effect_tests.push_back(additions.model.revise({.prune = how.prune, .named = true}));
    if (additions.effect_tests.size() < kMostAdditions) continue;
    return fmt::format("Stopped after {} revisions: a larger model would fit these data only.", kMostAdditions);
  }
}

// Takes back the last revisions whose test assumed further effects that were not added after them. Returns why.
std::string take_back_assumed(Additions& additions, std::vector<std::string> texts) {
  std::string why;
  while (!additions.effect_tests.empty() && !additions.effect_tests.back().beside.empty()) {
    const EffectTest& last = additions.effect_tests.back();
    why = fmt::format("Not added: {}, whose test assumes that {} {} missing as well.", labels_of_added(last),
                      text_of(enumerated(effects_of(last.beside))), last.beside.size() == 1 ? "is" : "are");
    additions.model.go_back_to(texts.back());
    texts.pop_back();
    additions.effect_tests.pop_back();
  }
  return why;
}

void add_grown(const AutomaticAddition& how, const ModelData& data, Additions& additions) {
  const ProgressLine progress;
  additions.grown = grown_model(additions.model.text(), how.model.model.name(), additions.model.model(), data,
                                names_of(how.model.data), additions.drivers, how.model.catalogue);
  additions.model.set_text(additions.grown->bytes);
}

}  // namespace

std::string add_automatically(const AutomaticAddition& how, const ModelData& data, Additions& additions,
                              Verdict& verdict) {
  if (is_of_machine_errors(additions.model.model(), *data.series)) {
    verdict = Verdict::nothing;
    return add_errors(how, data, additions);
  }
  std::vector<std::string> texts;
  std::string stopped = add_named(how, additions, texts, verdict);
  if (const std::string why = take_back_assumed(additions, std::move(texts)); !why.empty()) {
    stopped += (stopped.empty() ? "" : " ") + why;
    verdict = Verdict::unexplained;
  }
  const bool is_one_run = data.series->runs.size() < 2;
  if (!how.named_only && data.level == Level::series && is_left(verdict)) {
    if (is_one_run) add_grown(how, data, additions);
    if (!is_one_run)
      stderr_line("data of several runs: only named effects are added; `ballbar train` takes several runs");
  }
  return stopped;
}

}  // namespace ballbar

// `ballbar add EFFECT... --model M DATA`: a new revision of the model, earlier effects tested anew, a row in its
// ledger; with --dry-run what that would change, and nothing is saved.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "ballbar/number_text.hpp"
#include "commands.hpp"
#include "diagnose/diagnosis_report.hpp"
#include "diagnose/effect_test_text.hpp"
#include "diagnose/grown.hpp"
#include "diagnose/next_command.hpp"
#include "diagnose/revised_model.hpp"
#include "model/effect_options.hpp"
#include "model/residual_report.hpp"
#include "terminal/caller.hpp"
#include "terminal/details.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/progress.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

constexpr std::size_t kMostAdditions = 6;

struct AddArguments {
  EffectOptions effect;
  std::string out;
  bool automatic = false;
  bool named_only = false;
  bool prune = false;
  bool dry_run = false;
  bool details = false;
  std::vector<std::string> replace;  // labels of effects of the model, taken out first
};

// What was added so far; the model's file is written once, at the end.
struct Additions {
  RevisedModel model;
  std::vector<EffectTest> effect_tests;
  std::vector<Driver> drivers;      // that the last diagnosis knows
  std::optional<GrownModel> grown;  // after them
};

// The model's file is then that which is written.
ModelOptions written_to(const AddArguments& options) {
  ModelOptions written = options.effect.model;
  if (!options.out.empty()) written.model = options.out;
  return written;
}

// Which file is to be written, the command line has to say.
void expect_file(const AddArguments& options) {
  if (!options.effect.model.model.empty() || !options.out.empty()) return;
  std::vector<std::string> words;
  words.reserve(options.effect.words.size() + 2 * options.effect.model.target.size());
  for (const Source& word : options.effect.words) words.push_back(shell_word(word.name()));
  for (const std::string& target : options.effect.model.target)
    words.insert(words.end(), {"--target", shell_word(target)});
  throw CLI::ValidationError(
      "--model", fmt::format("expected the model's file, which is made where there is none, as in ballbar add {}{} "
                             "--model {}",
                             options.automatic ? "--auto " : "", fmt::join(words, " "), model_file({})));
}

RevisedModel opened_model(const ModelOptions& options, const std::shared_ptr<const ModelData>& data) {
  const ModelOptions start = readable(options);
  const Model model = open_model(start, *data);
  expect_one_target(start, model);
  return {options, data, model};
}

void add_terms(const AddArguments& options, const std::vector<Term>& terms, Additions& additions) {
  additions.model.add(terms, options.replace);
  additions.effect_tests.push_back(additions.model.revise({.prune = options.prune}));
}

// A new effect may not read what the file is to explain beside the target chosen here.
void expect_file_suits(const AddArguments& options, const ModelData& data, const std::string& bytes) {
  if (data.level == Level::recording) return;
  Model file = read_model(bytes, options.effect.model.model.name());
  const std::vector<std::string>& also = options.effect.model.also_input;
  std::erase_if(file.targets, [&](const std::string& target) {
    return find_column(*data.series, target) == nullptr || std::find(also.begin(), also.end(), target) != also.end();
  });
  if (!file.targets.empty()) with_source(options.effect.model.model.name(), [&] { expect_suits(file, *data.series); });
}

std::string labels_of_added(const EffectTest& tried) {
  std::vector<std::string> names;
  for (const Candidate& one : tried.added) names.push_back(one.label);
  return enumeration(names);
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
std::string stop_text(const AddArguments& options, const Diagnosis& diagnosis) {
  const std::string why = diagnosis.reasons.empty() ? "" : fmt::format(" {}", fmt::join(diagnosis.reasons, " "));
  const std::string hint = next_hint(written_to(options), diagnosis);
  switch (diagnosis.verdict) {
    case Verdict::nothing:
      return diagnosis.hidden_um > 0.0
                 ? fmt::format("Stopped: no further effect is found. Up to {} um of {} could still be hidden.{}",
                               size_text(diagnosis.hidden_um), label_of(diagnosis.hidden), why)
                 : fmt::format("Stopped: no further effect is found.{}", why);
    case Verdict::named:
    case Verdict::probable:
      return fmt::format("Stopped. {}{}{}{}", diagnosis.sentence, hint.empty() ? "" : " ", hint, why);
    case Verdict::driver:
      return fmt::format("Stopped. {}{}", diagnosis.sentence, why);
    case Verdict::equivalent:
      return fmt::format("Stopped: an effect is missing, but the data do not tell which: {}.{}",
                         either_text(diagnosis.equivalent), why);
    case Verdict::unexplained:
      return fmt::format("Stopped: something is missing that no known effect explains.{}", why);
    default:
      return fmt::format("Stopped: these data cannot test any further effect.{}", why);
  }
}

// The errors of the axes that are significant, each a revision, first the one that leaves least. Returns why it
// stopped.
std::string add_errors(const AddArguments& options, const ModelData& data, Additions& additions) {
  const MachineErrors found =
      with_source(options.effect.model.data.front().name(), [&] { return machine_errors_of_trace(*data.series); });
  for (const AddedError& one : found.one_by_one) {
    const std::vector<Term>& terms = additions.model.model().terms;
    const bool has =
        std::any_of(terms.begin(), terms.end(), [&](const Term& term) { return term.effect.get() == one.effect; });
    if (has) continue;
    add_terms(options, {term_of(one.effect->name, {}, Level::recording)}, additions);
    additions.effect_tests.back().after.verdict = name_of(Verdict::named);
  }
  const double left_um = found.residual_rms_um;
  return found.left ? fmt::format(
                          "Stopped: no other error of the axes is significant. A wave of {} per turn remains that no "
                          "known effect explains.",
                          found.left->harmonic)
                    : fmt::format(
                          "Stopped: no other error of the axes is significant. With all errors, {:.2f} um RMS "
                          "remains.",
                          left_um);
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
std::string add_supported(const AddArguments& options, std::vector<Term> terms, RevisedModel& model) {
  std::string why;
  while (!terms.empty()) {
    model.add(terms, options.replace);
    const EffectTest& tried = model.bench().added();
    if (tried.after.verdict != kNotSupported) return "";
    if (why.empty()) why = conclusion(tried);
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
std::string add_named(const AddArguments& options, Additions& additions, std::vector<std::string>& texts,
                      Verdict& verdict) {
  while (true) {
    show_progress(fmt::format("searching, {} revisions so far", additions.effect_tests.size()));
    const Diagnosis diagnosis =
        with_source(options.effect.model.data.front().name(), [&] { return additions.model.bench().diagnosis(); });
    verdict = diagnosis.verdict;
    additions.drivers = diagnosis.drivers;
    if (diagnosis.named.empty()) return stop_text(options, diagnosis);
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
    if (const std::string why = add_supported(options, std::move(terms), additions.model); !why.empty()) {
      verdict = Verdict::unexplained;
      return fmt::format("Stopped, and not added. {}", why);
    }
    texts.push_back(additions.model.text());
    additions.effect_tests.push_back(additions.model.revise({.prune = options.prune, .named = true}));
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
                      enumeration(last.beside), last.beside.size() == 1 ? "is" : "are");
    additions.model.go_back_to(texts.back());
    texts.pop_back();
    additions.effect_tests.pop_back();
  }
  return why;
}

void add_grown(const AddArguments& options, const ModelData& data, Additions& additions) {
  const ProgressLine progress;
  additions.grown = grown_model(additions.model.text(), options.effect.model.model.name(), additions.model.model(),
                                data, names_of(options.effect.model.data), additions.drivers);
  additions.model.set_text(additions.grown->bytes);
}

std::vector<std::string> causes_of(const Additions& additions) {
  std::vector<std::string> causes;
  for (const EffectTest& tried : additions.effect_tests) {
    if (tried.after.verdict == kNotSupported) continue;
    for (const Candidate& added : tried.added) {
      if (!added.bound.effect->time_only) causes.push_back(added.label);
    }
  }
  return causes;
}

std::size_t revisions_of(const Additions& additions) {
  return additions.effect_tests.size() + (additions.grown ? additions.grown->rows.size() : 0);
}

// Behind the sentence that says it.
std::string unneeded_text(const EffectTest& tried) {
  const std::vector<std::string>& labels = tried.after.no_longer_needed;
  if (labels.empty()) return "";
  return fmt::format(" --prune takes {} out.", labels.size() == 1 ? "it" : "them");
}

Added added_of(const Additions& additions) {
  Added added;
  for (const EffectTest& tried : additions.effect_tests)
    added.rows.push_back({tried.after, sentence(tried.after, &tried.before)});
  added.revisions = additions.effect_tests;
  if (!additions.grown) return added;
  const LedgerRow& before =
      additions.effect_tests.empty() ? additions.grown->before : additions.effect_tests.back().after;
  for (LedgerEntry& entry : ledger_of(additions.grown->rows, &before).rows) added.rows.push_back(std::move(entry));
  added.growth.value = steps_of(*additions.grown);
  added.sentence.value = conclusion(*additions.grown, causes_of(additions), additions.drivers);
  return added;
}

constexpr std::string_view kDetails = "the tests of the earlier effects, all parameters, and what the figures mean";

// Of several revisions the row of each, and what the last one is worth.
void print_text(const Additions& additions, const std::string& stopped, const std::string& title, bool details) {
  fmt::print("{}\n\n", title);
  for (const EffectTest& tried : additions.effect_tests) {
    if (details || &tried == &additions.effect_tests.back()) fmt::print("{}", wrapped(conclusion(tried)));
    fmt::print("{}", wrapped(sentence(tried.after, &tried.before) + unneeded_text(tried)));
  }
  if (additions.grown) {
    fmt::print("{}{}\n{}\n{}", additions.effect_tests.empty() ? "" : "\n",
               wrapped(conclusion(*additions.grown, causes_of(additions), additions.drivers)),
               tables(*additions.grown, details), wrapped(stopped));
    return;
  }
  if (!stopped.empty()) fmt::print("{}{}", additions.effect_tests.empty() ? "" : "\n", wrapped(stopped));
  if (additions.effect_tests.empty()) return;
  fmt::print("\n{}", tables(additions.effect_tests.back(), details));
  if (!details) fmt::print("\n{}", details_text(kDetails));
}

// The model with and without the effects; no file is needed, none is written.
void try_effects(EffectOptions options, bool details) {
  split_words(options, true);
  const auto data = std::make_shared<const ModelData>(open_data(options.model));
  const Model model = open_model(options.model, *data);
  say_start(options.model, *data);
  expect_one_target(options.model, model);
  Workbench bench = workbench_of(options.model, data, model);
  const std::vector<Term> terms = terms_of(options.effects, model, *data);
  const ProgressLine progress;
  show_progress(fmt::format("fitting {} with and without what is added", model.targets.front()));
  EffectTest tested = with_source(options.model.data.front().name(), [&] { return bench.effect_test(terms); });
  show_progress({});
  tested.after.data = names_of(options.model.data);
  const std::string saves = add_command(options.model, tested);
  if (options.json) {
    print_json(json_of(tested));
    return;
  }
  fmt::print("{}\n{}\n\n{}\n{}\nNothing was saved. {}\n", data->title, heading(tested.fit_after),
             wrapped(conclusion(tested)), tables(tested, details),
             saves.empty() ? "Run it without --dry-run to save it." : "To save it:\n" + saves);
  if (!details) fmt::print("\n{}", details_text(kDetails));
}

void run(AddArguments options) {
  if (options.dry_run) return try_effects(options.effect, options.details);
  if (options.named_only && !options.automatic) throw CLI::ValidationError("--named-only: expected --auto");
  split_words(options.effect, !options.automatic);
  expect_file(options);
  const ProgressLine progress;
  const ModelOptions& how = options.effect.model;
  const auto opened = std::make_shared<const ModelData>(open_data(how));
  const ModelData& data = *opened;
  Additions additions{opened_model(how, opened), {}, {}, {}};
  const Source to = written_to(options).model;
  const std::string& out = to.name();
  if (additions.model.is_new())
    stderr_line(fmt::format("{} is new: it starts from {} alone", out, start_of(data.level)));
  if (!options.out.empty()) expect_no_input({options.out}, data.files);
  std::string stopped;
  Verdict verdict = Verdict::named;
  if (options.automatic) {
    if (is_of_machine_errors(additions.model.model(), *data.series)) {
      stopped = add_errors(options, data, additions);
      verdict = Verdict::nothing;
    } else {
      std::vector<std::string> texts;
      stopped = add_named(options, additions, texts, verdict);
      if (const std::string why = take_back_assumed(additions, std::move(texts)); !why.empty()) {
        stopped += (stopped.empty() ? "" : " ") + why;
        verdict = Verdict::unexplained;
      }
      const bool is_one_run = data.series->runs.size() < 2;
      if (!options.named_only && data.level == Level::series && is_left(verdict)) {
        if (is_one_run) add_grown(options, data, additions);
        if (!is_one_run)
          stderr_line("data of several runs: only named effects are added; `ballbar train` takes several runs");
      }
    }
  } else {
    show_progress("fitting with and without what is added");
    add_terms(options, terms_of(options.effect.effects, additions.model.model(), data), additions);
  }
  show_progress({});
  expect_file_suits(options, data, additions.model.text());
  const bool changed = revisions_of(additions) > 0;
  if (changed && to.is_path()) write_bytes(out, additions.model.text());
  if (options.effect.json) {
    Added added = added_of(additions);
    if (options.automatic) added.stopped.value = {verdict, stopped};
    if (changed && to.is_path()) added.written = out;
    if (changed && !to.is_path()) added.text.value = additions.model.text();
    print_json(json_of(added));
  } else {
    print_text(additions, stopped, data.title, options.details);
  }
  if (!changed) {
    stderr_line("nothing added, nothing written");
    return;
  }
  const std::vector<std::string> targets = read_model(additions.model.text(), how.model.name()).targets;
  if (targets.size() > 1) {
    stderr_line(fmt::format("{} holds for all its targets, {}; the ledger's row is of {}", out,
                            fmt::join(targets, ", "), additions.model.model().targets.front()));
  }
  if (to.is_path()) wrote_line(out);
}

}  // namespace

void add_add(CLI::App& app) {
  const auto options = std::make_shared<AddArguments>();
  CLI::App* command = app.add_subcommand("add", "A new revision of a model with more effects, and its ledger");
  add_effect_options(*command, options->effect,
                     "effects (none with --auto), NAME, 'NAME(COLUMN, ...)' or NAME:ROLE=COLUMN,..., then series .csv, "
                     "session, or recordings");
  command->add_option("--out", options->out, "write the new revision there instead of into the model's file")
      ->type_name("FILE");
  CLI::Option* automatic =
      command->add_flag("--auto", options->automatic,
                        "add what diagnose names; of a series then what predicts, as long as it predicts new cycles");
  command->add_flag("--named-only", options->named_only, "with --auto: what diagnose names, and no more");
  command
      ->add_option("--replace", options->replace,
                   "an effect of the model, as its ledger has it, that the added ones replace: it is taken out")
      ->type_name("EFFECT")
      ->allow_extra_args(false)
      ->excludes(automatic);
  command->add_flag("--prune", options->prune, "take earlier effects out that are no longer needed");
  CLI::Option* dry_run =
      command->add_flag("--dry-run", options->dry_run,
                        "before and after the effects are added; nothing is saved, and no model's file is needed");
  for (const char* of_a_file : {"--out", "--auto", "--named-only", "--replace", "--prune"}) {
    dry_run->excludes(command->get_option(of_a_file));
  }
  add_details(*command, options->details);
  command->footer(
      "Examples:\n"
      "  ballbar add lagged_expansion:temperature=T16_degC sample-runs/spindle-46h/measured.csv \\\n"
      "    --model sample-runs/spindle-46h/speed.toml --target ch3_um --dry-run\n"
      "  ballbar add lagged_expansion:temperature=T16_degC sample-runs/spindle-46h/measured.csv \\\n"
      "    --model sample-runs/spindle-46h/speed.toml --target ch3_um --out model.toml");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands

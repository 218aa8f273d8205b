// `ballbar add EFFECT... --model M DATA`: a new revision of the model, earlier effects tested anew, a row in its
// ledger; with --dry-run what that would change, and nothing is saved.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "commands.hpp"
#include "diagnose/automatic_addition.hpp"
#include "diagnose/diagnosis_report.hpp"
#include "diagnose/effect_test_text.hpp"
#include "diagnose/grown.hpp"
#include "diagnose/ledger_text.hpp"
#include "diagnose/next_command.hpp"
#include "diagnose/revised_model.hpp"
#include "model/effect_options.hpp"
#include "model/residual_report.hpp"
#include "model/resolve_columns.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/state_file.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

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

void add_terms(const AddArguments& options, const std::vector<Term>& terms, const ModelData& data,
               Additions& additions) {
  std::vector<std::string> replaced = options.replace;
  if (data.level == Level::series) {
    for (std::string& label : replaced) label = with_column_names(label, *data.series);
  }
  additions.model.add(terms, replaced);
  additions.effect_tests.push_back(additions.model.revise({.prune = options.prune}));
}

// A new effect may not read what the file is to explain beside the target chosen here.
void expect_file_suits(const AddArguments& options, const ModelData& data, const std::string& bytes) {
  if (data.level == Level::recording) return;
  Model file = read_model(bytes, options.effect.model.model.name(), options.effect.model.catalogue);
  const std::vector<std::string> also = also_inputs(options.effect.model, *data.series);
  std::erase_if(file.targets, [&](const std::string& target) {
    return find_column(*data.series, target) == nullptr || std::find(also.begin(), also.end(), target) != also.end();
  });
  if (!file.targets.empty()) with_source(options.effect.model.model.name(), [&] { expect_suits(file, *data.series); });
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
    added.rows.push_back({tried.after, sentence_of(tried.after, &tried.before)});
  added.revisions = additions.effect_tests;
  if (!additions.grown) return added;
  const LedgerRow& before =
      additions.effect_tests.empty() ? additions.grown->before : additions.effect_tests.back().after;
  for (LedgerEntry& entry : ledger_of(additions.grown->rows, &before).rows) added.rows.push_back(std::move(entry));
  added.growth = steps_of(*additions.grown);
  added.sentence = conclusion(*additions.grown, causes_of(additions), additions.drivers);
  return added;
}

constexpr std::string_view kDetails = "the tests of the earlier effects, all parameters, and what the figures mean";

// Of several revisions the row of each, and what the last one is worth.
void print_text(const Additions& additions, const std::string& stopped, const std::string& title, bool details) {
  fmt::print("{}\n\n", title);
  for (const EffectTest& tried : additions.effect_tests) {
    if (details || &tried == &additions.effect_tests.back()) fmt::print("{}", wrapped(conclusion(tried)));
    fmt::print("{}", wrapped(text_of(sentence_of(tried.after, &tried.before)) + unneeded_text(tried)));
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
  const Source to = written_to(options).model;
  const auto lock = to.is_path() ? only_writer(to.path(), "ballbar add") : std::nullopt;  // before the file is read
  const ProgressLine progress;
  const ModelOptions& how = options.effect.model;
  const auto opened = std::make_shared<const ModelData>(open_data(how));
  const ModelData& data = *opened;
  Additions additions{opened_model(how, opened), {}, {}, {}};
  const std::string& out = to.name();
  if (additions.model.is_new())
    stderr_line(fmt::format("{} is new: it starts from {} alone", out, start_of(data.level)));
  if (!options.out.empty()) expect_no_input({options.out}, data.files);
  std::string stopped;
  Verdict verdict = Verdict::named;
  if (options.automatic) {
    stopped =
        add_automatically({how, written_to(options), options.prune, options.named_only}, data, additions, verdict);
  } else {
    show_progress("fitting with and without what is added");
    add_terms(options, terms_of(options.effect.effects, additions.model.model(), data), data, additions);
  }
  show_progress({});
  expect_file_suits(options, data, additions.model.text());
  const bool changed = revisions_of(additions) > 0;
  if (changed && to.is_path()) write_bytes(out, additions.model.text());
  if (options.effect.json) {
    Added added = added_of(additions);
    if (options.automatic) added.stopped = {verdict, stopped};
    if (changed && to.is_path()) added.written = out;
    if (changed && !to.is_path()) added.text = additions.model.text();
    print_json(json_of(added));
  } else {
    print_text(additions, stopped, data.title, options.details);
  }
  if (!changed) {
    stderr_line("nothing added, nothing written");
    return;
  }
  const std::vector<std::string> targets = read_model(additions.model.text(), how.model.name(), how.catalogue).targets;
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

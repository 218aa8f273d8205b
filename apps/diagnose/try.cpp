// `ballbar try EFFECT... DATA`: what an effect would change; nothing is saved.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.hpp"
#include "diagnose/effect_test_text.hpp"
#include "diagnose/next_command.hpp"
#include "diagnose/revision_results.hpp"
#include "model/effect_options.hpp"
#include "model/known_effect.hpp"
#include "model/residual_report.hpp"
#include "model/workbench_of.hpp"
#include "terminal/caller.hpp"
#include "terminal/progress.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

void run(EffectOptions options) {
  split_words(options, true);
  for (const std::string& effect : options.effects) expect_known_effect(effect, true);
  const auto data = std::make_shared<const ModelData>(open_data(options.model));
  const Model model = open_model(options.model, *data);
  say_start(options.model, *data);
  expect_one_target(options.model, model);
  Workbench bench = workbench_of(options.model, data, model);
  const std::vector<Term> terms = terms_of(options.effects, model, *data);
  const ProgressLine progress;
  show_progress(fmt::format("fitting {} with and without what is tried", model.targets.front()));
  EffectTest tried = with_source(options.model.data.front().name(), [&] { return bench.effect_test(terms); });
  show_progress({});
  tried.after.data = names_of(options.model.data);
  const std::string saves = add_command(options.model, tried);
  if (options.json) {
    print_json(json_of(tried));
    return;
  }
  fmt::print("{}\n{}\n\n{}\n{}\nNothing was saved; {}\n", data->title, heading(tried.fit_after),
             wrapped(conclusion(tried)), tables(tried),
             saves.empty() ? "`ballbar add` saves it." : "this saves it:\n" + saves);
}

}  // namespace

void add_try(CLI::App& app) {
  const auto options = std::make_shared<EffectOptions>();
  CLI::App* command = app.add_subcommand("try", "Before and after an effect is added to a model; nothing is saved");
  add_effect_options(
      *command, *options,
      "effects, NAME, 'NAME(COLUMN, ...)' or NAME:ROLE=COLUMN,..., then series .csv, session, or recordings");
  command->footer(
      "Example:\n"
      "  ballbar try lagged_expansion:temperature=T16_degC sample-runs/spindle-46h/measured.csv \\\n"
      "    --model sample-runs/spindle-46h/speed.toml --target ch3_um");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands

// `ballbar could [EFFECT] DATA`: what these data could show, before looking at any residual; of one effect by adding
// it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.hpp"
#include "diagnose/injection.hpp"
#include "model/effect_options.hpp"
#include "model/preflight.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

struct CouldArguments {
  EffectOptions of;
  InjectionOptions injection;
  bool details = false;
};

void run(CouldArguments options, const std::vector<CLI::Option*>& of_an_effect) {
  split_words(options.of, std::nullopt);
  const std::vector<std::string>& effects = options.of.effects;
  if (effects.size() > 1) {
    throw CLI::ValidationError("EFFECT",
                               fmt::format("expected one effect to add, found {} and {}", effects.front(), effects[1]));
  }
  if (effects.empty()) expect_none_given(of_an_effect, "an EFFECT");
  const ModelOptions& how = options.of.model;
  const ModelData data = open_data(how);
  const Model model = open_model(how, data);
  say_start(how, data);
  if (effects.empty()) return show_preflight(how, model, data, options.of.json, options.details);
  options.injection.effect = effects.front();
  show_injection(options.injection, how, model, data, options.of.json);
}

}  // namespace

void add_could(CLI::App& app) {
  const auto options = std::make_shared<CouldArguments>();
  CLI::App* command = app.add_subcommand("could", "Which effects these data could show, and from which size");
  add_effect_options(*command, options->of,
                     "one effect, NAME, 'NAME(COLUMN, ...)' or NAME:ROLE=COLUMN,..., or none for all of them; then "
                     "series .csv, session, or recordings");
  InjectionOptions& injection = options->injection;
  std::vector<CLI::Option*> of_an_effect;
  of_an_effect.push_back(
      command
          ->add_option("--amplitude-um", injection.amplitude_um,
                       "of EFFECT: its largest less its smallest value; default: from which it should be named")
          ->type_name("UM")
          ->check(number_above_0()));
  of_an_effect.push_back(command
                             ->add_option("--set", injection.shapes,
                                          "of EFFECT: a shape of it, such as time_constant_s=1800; may be repeated")
                             ->type_name("NAME=VALUE")
                             ->allow_extra_args(false)
                             ->check(name_and_number()));
  of_an_effect.push_back(command->add_option("--out", injection.out, "write the data with EFFECT added, .csv")
                             ->type_name("FILE")
                             ->check(name_that_ends_in({".csv"})));
  add_details(*command, options->details);
  command->footer(
      "Examples:\n"
      "  ballbar could sample-runs/two-arcs-he2015 --target y_um\n"
      "  ballbar could lagged_expansion:temperature=T16_degC sample-runs/spindle-46h/measured.csv \\\n"
      "    --model sample-runs/spindle-46h/speed.toml --target ch5_um");
  command->callback([options, of_an_effect] { run(*options, of_an_effect); });
}

}  // namespace ballbar::commands

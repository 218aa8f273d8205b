// `ballbar effects [NAME]`: the catalogue, one effect's page, or the glossary. Printed from the code.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include "ballbar/effects/effect.hpp"
#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/model/model.hpp"
#include "commands.hpp"
#include "model/effects_result.hpp"
#include "terminal/caller.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

constexpr std::size_t kMeaningWidth = 50;
constexpr std::size_t kSummaryWidth = 62;

// In the order of their names.
constexpr ExplainedTerm kTerms[] = {
    {"2 ln B",
     "Twice the natural logarithm of the Bayes factor: how much more likely the readings are with an effect than "
     "without. 0 is even, 10 is 150 to 1."},
    {"P", "Probability of the statement, 0 to 1; 0.98 is 49 to 1."},
    {"p", "Probability that noise alone gives the observed value or a larger one."},
    {"RMS", "Root of the mean square: the usual size of values that go to both sides of 0."},
    {"RMSE", "Error that remains with a model, in um: root of the mean square of measured less modelled."},
    {"autocorrelation", "How alike readings some steps apart are, -1 to 1; 0: not at all."},
    {"bias", "Mean of measured less modelled: how far a model is off to one side."},
    {"chi^2", "Sum of the squares of the residual, each in units of its own scatter; its fall weighs an effect."},
    {"coherence", "Correlation of two signals at each frequency, 0 to 1."},
    {"correlation", "How closely two values vary together, -1 to 1. Near -1 and 1 the data cannot separate them."},
    {"discrepancy", "Slow part of the residual without a known cause."},
    {"evidence", "Support of the readings for one explanation against another. Extra parameters count against it."},
    {"forecast", "Prediction of readings later than all those that the model was fitted to."},
    {"independent", "Correlated readings repeat each other: so many uncorrelated ones would say as much."},
    {"left out", "Not used in the fit, then predicted: how a model does on readings that it has not seen."},
    {"misfit", "Sum of the squares of the residual: the model fails most where most of it is."},
    {"noise", "Scatter of readings that should be equal: the error that remains at best, which no model can explain."},
    {"periodogram", "How much of the residual changes at each pace; of white noise, the same at all."},
    {"prior", "What is assumed before the readings, where they alone would hardly decide."},
    {"robust", "With outliers discounted, so that they do not affect the result."},
    {"sigma",
     "Standard uncertainty of a value, the number after ±: 68 % of repeats lie within one sigma, 95 % within two."},
    {"significant", "Noise alone would give such a value in 1 of 100 tests at most."},
    {"standard deviation", "Root mean square deviation from the mean: 68 % of values lie within it."},
    {"variance", "Square of the standard deviation."},
    {"white", "Noise whose readings do not depend on each other."},
    {"whitened", "Freed of the correlation of the noise, so that the rest should be white."},
};

struct EffectsArguments {
  std::string name;
  bool terms = false;
  bool details = false;
  bool json = false;
};

std::vector<const Effect*> all_effects() {
  std::vector<const Effect*> all;
  for (const auto& effect : built_in_catalogue()) all.push_back(effect.get());
  all.push_back(&expression_page());
  return all;
}

const char* level_text(Level level) { return level == Level::series ? "on a drift series" : "on a recording"; }

std::string names_on(Level level) {
  std::vector<std::string> names;
  for (const Effect* effect : all_effects()) {
    if (effect->level == level) names.push_back(effect->name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

// Without details those on a recording by their names alone: a screen.
void print_list(bool details) {
  for (const Level level : {Level::series, Level::recording}) {
    if (level == Level::recording && !details) {
      fmt::print("{}{}\n", wrapped(fmt::format("{}: {}.", level_text(level), names_on(level))),
                 "--details describes these.\n");
      continue;
    }
    Table table({level_text(level), "inputs", "description"});
    for (const Effect* effect : all_effects()) {
      if (effect->level != level) continue;
      std::vector<std::string> inputs;
      for (const Input& input : effect->inputs) inputs.push_back(input.role);
      const std::string none = effect == &expression_page() ? "any" : "time";
      table.add_wrapped({effect->name, inputs.empty() ? none : fmt::format("{}", fmt::join(inputs, ", ")),
                         effect->explanation.summary},
                        kSummaryWidth);
    }
    fmt::print("{}\n", table.left_aligned());
  }
  fmt::print("ballbar effects NAME explains one effect, ballbar effects --terms the statistical terms.\n");
}

void print_terms(bool json) {
  if (json) return print_json(json_of(EffectPages{{}, {std::begin(kTerms), std::end(kTerms)}}));
  Table table({"term", "meaning"});
  for (const ExplainedTerm& term : kTerms) table.add({std::string(term.name), std::string(term.meaning)});
  fmt::print("{}", table.left_aligned(table_width()));
}

void print_part(const char* heading, const std::string& text) {
  if (!text.empty()) fmt::print("{}\n{}\n", heading, wrapped(text, 90));
}

std::string bound(double value) { return std::isfinite(value) ? fmt::format("{:g}", value) : "-"; }

void print_page(const Effect& effect) {
  const Explanation& page = effect.explanation;
  fmt::print("{}, {}\n{}\n", effect.name, level_text(effect.level), wrapped(page.summary));
  print_part("Cause", page.cause);
  print_part("Formula", page.formula);
  print_part("Signature", page.signature);
  print_part("On parts", page.on_parts);
  if (!effect.inputs.empty()) {
    Table inputs({"input", "unit", "meaning"});
    for (const Input& input : effect.inputs) {
      const std::string units = input.units.empty() ? "any" : fmt::format("{}", fmt::join(input.units, ", "));
      inputs.add_wrapped({input.role, units, input.meaning}, kMeaningWidth);
    }
    fmt::print("{}", inputs.left_aligned());
    const bool measured = effect.level == Level::series &&
                          std::any_of(effect.inputs.begin(), effect.inputs.end(), [](const Input& input) {
                            return std::find(input.units.begin(), input.units.end(), "um") != input.units.end();
                          });
    if (measured) {
      fmt::print("{}", wrapped("A measured column is interpolated linearly between its values and held at the nearest "
                               "value outside them."));
    }
    fmt::print("\n");
  }
  if (!effect.parameters.empty()) {
    Table parameters({"parameter", "unit", "start", "lowest", "highest", "meaning"});
    for (const Parameter& parameter : effect.parameters) {
      parameters.add_wrapped(
          {parameter.name, parameter.unit, fmt::format("{:g}{}", parameter.start, parameter.held ? " held" : ""),
           bound(parameter.lower), bound(parameter.upper), parameter.meaning},
          kMeaningWidth);
    }
    fmt::print("{}\n", parameters.left_aligned());
  }
  for (const Parameter& parameter : effect.parameters) {
    if (!parameter.usual.empty())
      print_part("Usual", fmt::format("{} of {:g} to {:g} {}: {}.", parameter.name, parameter.usual_low,
                                      parameter.usual_high, parameter.unit, parameter.usual));
  }
  print_part("Confused with", fmt::format("{}", fmt::join(page.confused_with, ", ")));
  if (!effect.rules.becomes.empty()) print_part("Becomes", effect.rules.becomes + ", at the limits of its parameters");
  print_part("Distinguished by", page.separated_by);
  print_part("Remedy", page.remedy);
  print_part("Validity", page.validity);
  print_part("Source", page.source);
  if (effect.time_only) {
    fmt::print(
        "{}",
        wrapped("This effect depends on time alone. One run can have its shape, but cannot prove it as the cause."));
  }
}

void run(const EffectsArguments& options) {
  if (options.terms) return print_terms(options.json);
  std::vector<const Effect*> chosen;
  std::vector<std::string_view> names;
  const std::string name = options.name.substr(0, options.name.find_first_of(":( "));  // of a label, as one is printed
  for (const Effect* effect : all_effects()) {
    names.push_back(effect->name);
    if (options.name.empty() || effect->name == name) chosen.push_back(effect);
  }
  if (chosen.empty()) {
    throw CLI::ValidationError(fmt::format("expected the name of an effect, found {}; the nearest is {}",
                                           in_quotes(options.name), nearest_name(options.name, names)));
  }
  if (options.json) {
    Json pages = Json::array();
    for (const Effect* effect : chosen) pages.push_back(json_value(*effect));
    print_json(pages);
  } else if (options.name.empty()) {
    print_list(options.details);
  } else {
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (i > 0) fmt::print("\n");
      print_page(*chosen[i]);
    }
  }
}

}  // namespace

void add_effects(CLI::App& app) {
  const auto options = std::make_shared<EffectsArguments>();
  CLI::App* command = app.add_subcommand("effects", "List the physical effects, or explain one");
  CLI::Option* name = command->add_option("NAME", options->name, "effect to explain; default: list all");
  name->type_name("");
  command->add_flag("--details", options->details, "describe all effects in the list");
  command->add_flag("--json", options->json, "print the result as JSON");
  command->add_flag("--terms", options->terms, "explain the statistical terms")->excludes(name);
  command->footer("Example:\n  ballbar effects backlash_a");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands

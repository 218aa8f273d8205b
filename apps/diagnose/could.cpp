// `ballbar could [EFFECT] DATA`: what these data could show, before looking at any residual; of one effect by adding
// it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/diagnosis/injection/injection.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "commands.hpp"
#include "diagnose/inject_result.hpp"
#include "model/effect_options.hpp"
#include "model/model_options.hpp"
#include "model/preflight.hpp"
#include "model/residual_report.hpp"
#include "model/resolve_columns.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

struct InjectionOptions {
  std::string effect;                  // as `add` takes it
  std::optional<double> amplitude_um;  // range (max - min); nullopt: that from which it should be named
  std::vector<std::string> shapes;     // NAME=VALUE
  std::string out;                     // .csv; empty: none
};

constexpr double kNeverNamed_um = 1e6;  // a metre

// --set NAME=VALUE
void set_shape(Injection& injection, const std::string& text) {
  const Effect& effect = *injection.bound.effect;
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  std::vector<std::string_view> shapes;
  for (const Parameter& parameter : effect.parameters) {
    if (parameter.kind == ParameterKind::shape) shapes.emplace_back(parameter.name);
  }
  if (shapes.empty()) {
    throw Error(
        fmt::format("--set: expected no shape for {}, which has none, found {}.", effect.name, in_quotes(text)));
  }
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const Parameter& parameter = effect.parameters[k];
    if (parameter.kind != ParameterKind::shape || parameter.name != name) continue;
    const auto value = finite_number(std::string_view(text).substr(std::min(text.size(), name.size() + 1)));
    if (!value) throw Error(fmt::format("--set: expected {}=NUMBER, found {}.", name, in_quotes(text)));
    if (*value < parameter.lower || *value > parameter.upper) {
      throw Error(fmt::format("--set: expected a value from {} to {} for {}, found {}.", parameter.lower,
                              parameter.upper, name, *value));
    }
    injection.parameters[k] = *value;
    return;
  }
  throw Error(fmt::format("--set: expected a shape of {}, {}, found {}; the nearest is {}.", effect.name,
                          fmt::join(shapes, ", "), in_quotes(name), nearest_name(name, shapes)));
}

std::string shapes_text(const Injection& injection) {
  std::vector<std::string> texts;
  for (const auto& [name, value] : shapes_of(injection)) texts.push_back(fmt::format("{} = {:g}", name, value));
  return texts.empty() ? "" : fmt::format(" with {}", fmt::join(texts, ", "));
}

void print_injection(const Injected& result, const std::string& title) {
  fmt::print("{}\n{}\n\n", title, heading(result.base));
  fmt::print(
      "{}\n",
      wrapped(fmt::format(
          "Added: {}{}, {:.4g} um from its lowest to its highest value. Against the noise of the residual this is d = "
          "{:.1f}. The effect is visible from {:.2g} um (d = 5) and can be named from {:.2g} um (d = 7.5).",
          label_of(result.injection.bound), shapes_text(result.injection), result.amplitude_um, result.d,
          result.amplitude_of_um(kDetectable), result.amplitude_of_um(kIdentifiable))));
  Table table({"", "verdict", label_of(result.injection.bound)});
  const auto add = [&](const char* what, const Diagnosis& found) {
    table.add({what, std::string(name_of(found.verdict)), std::string(name_of(result.sighting(found).sight))});
  };
  add("as measured", result.without);
  add("with it", result.with);
  fmt::print("{}\n{}", table.left_aligned(), wrapped(answer_text(result)));
}

Injection injection(const InjectionOptions& options, const Model& model, const ModelData& data) {
  EffectText text;
  BoundEffect bound;
  try {
    const bool has_columns = data.level == Level::series;
    text = effect_text(has_columns ? with_column_names(options.effect, *data.series) : options.effect, data.level,
                       data.series.get());
    bound = resolve_columns(text, *data.series, model.targets.front());
  } catch (const Error& error) {
    throw Error(fmt::format("EFFECT: {}", error.what()));
  }
  expect_no_target(label_of(bound), bound.columns, model);
  for (const Term& term : model.terms) {
    if (term.effect->name != bound.effect->name || term.columns != bound.columns) continue;
    throw Error(fmt::format("EFFECT: expected an effect that the model lacks, found {}.", label_of(bound)));
  }
  Injection result = injection_of(bound, *data.series);
  for (const auto& [parameter, setting] : text.settings) {
    const std::string& name = bound.effect->parameters[parameter].name;
    if (setting.stated) set_shape(result, fmt::format("{}={}", name, setting.start));
  }
  for (const std::string& shape : options.shapes) set_shape(result, shape);
  return result;
}

void show_progress_of(std::size_t diagnosis) { show_progress(fmt::format("diagnosis {}", diagnosis)); }

void expect_out(const InjectionOptions& options, const ModelOptions& of, const ModelData& data) {
  if (options.out.empty()) return;
  std::vector<std::filesystem::path> inputs = data.files;
  if (of.model.is_path()) inputs.push_back(of.model.path());
  expect_no_input({options.out}, inputs);
  if (data.level == Level::recording) throw Error("--out: expected a series or a session, found recordings.");
}

Injected tested(const InjectionOptions& options, const ModelOptions& of, const Model& model, const ModelData& data,
                Series& changed) {
  const Series& series = *data.series;
  Injected result{injection(options, model, data), 0.0, {}, 0.0, {}, {}, {}};
  result.base = fit_of(of, model, data, 0);
  const std::vector<double> signal = with_source("EFFECT", [&] { return signal_of(result.injection, series); });
  const double d_per_um = survival_of(signal, result.base, result.base.noise).d / range_of(signal);
  result.amplitude_um = options.amplitude_um.value_or(kIdentifiable / d_per_um);
  if (!(result.amplitude_um < kNeverNamed_um)) {
    throw Error(
        fmt::format("EFFECT: expected an effect that the model cannot make already, found {}; --amplitude-um says "
                    "how much of it to add.",
                    label_of(result.injection.bound)));
  }
  changed = with_source("EFFECT",
                        [&] { return injected(series, model.targets.front(), result.injection, result.amplitude_um); });
  DiagnosisOptions how;
  how.search.motion = data.motion;
  how.fit_candidates = how.leave_out = false;
  show_progress_of(1);
  result.without = diagnose(model, series, 0, how);
  show_progress_of(2);
  result.with = diagnose(model, changed, 0, how);
  result.d = result.amplitude_um * d_per_um;
  result.smallest = {0.0, std::numeric_limits<double>::infinity(), 2};
  if (!is_detected(result.sighting(result.without).sight)) {
    const bool detected = is_detected(result.sighting(result.with).sight);
    (detected ? result.smallest.detected_um : result.smallest.undetected_um) = result.amplitude_um;
    result.smallest =
        detection_limit(model, series, result.injection, d_per_um, result.smallest, how, show_progress_of);
  }
  return result;
}

}  // namespace

std::string answer_text(const Injected& result) {
  const std::string label = label_of(result.injection.bound);
  const Sight before = result.sighting(result.without).sight;
  const Sight now = result.sighting(result.with).sight;
  if (is_detected(before)) {
    return fmt::format("These data already show {}: it is {} without anything added. What is added proves nothing.",
                       label, name_of(before));
  }
  std::string text;
  switch (now) {
    case Sight::named:
      text = "It would be named.";
      break;
    case Sight::probable:
      text = "It would be called probable.";
      break;
    case Sight::driver:
      text = "What drives it would be named, not the effect itself.";
      break;
    case Sight::in_set:
      text = "It would be one of the alternatives that are reported, but not named.";
      break;
    case Sight::candidate:
      text = "It would be the best candidate, but neither named nor reported as an alternative.";
      break;
    case Sight::unexplained:
      text = before == Sight::unexplained ? "It would not be seen: these data already have an unexplained part."
                                          : "It would show as something unexplained, not under its name.";
      break;
    case Sight::undetected:
      text = "It would not be seen.";
      break;
  }
  const DetectionLimit& smallest = result.smallest;
  if (!std::isfinite(smallest.detected_um)) {
    text += fmt::format(" Up to {:.2g} um it is neither named nor reported as an alternative", smallest.undetected_um);
  } else if (smallest.undetected_um > 0.0) {
    text += fmt::format(
        " The smallest amplitude that is named or reported as an alternative is between {:.2g} and {:.2g} um",
        smallest.undetected_um, smallest.detected_um);
  } else {
    text += fmt::format(" The smallest amplitude that is named or reported as an alternative is at most {:.2g} um",
                        smallest.detected_um);
  }
  text += fmt::format(" ({} diagnoses).", smallest.diagnoses);
  if (smallest.detected_um < result.amplitude_of_um(3.0))
    text += " This limit is low by chance: the noise happens to have a similar shape.";
  return text;
}

TableOf<double> shapes_of(const Injection& injection) {
  TableOf<double> shapes;
  for (std::size_t k = 0; k < injection.parameters.size(); ++k) {
    const Parameter& parameter = injection.bound.effect->parameters[k];
    if (parameter.kind == ParameterKind::shape) shapes.emplace_back(parameter.name, injection.parameters[k]);
  }
  return shapes;
}

namespace commands {
namespace {

struct CouldArguments {
  EffectOptions of;
  InjectionOptions injection;
  bool details = false;
};

// The verdicts with and without it, and the smallest detected amplitude. Throws Error: several targets, an effect that
// the model has or for which the data have no columns, --out with recordings.
void show_injection(const InjectionOptions& options, const ModelOptions& of, const Model& model, const ModelData& data,
                    bool json) {
  if (model.targets.size() != 1) {
    throw Error(fmt::format("--target: expected one column to add to, found {}: {}.", model.targets.size(),
                            fmt::join(model.targets, ", ")));
  }
  expect_out(options, of, data);
  expect_to_fit(of, model, data);
  Series changed;
  const ProgressLine line;
  const Injected result = tested(options, of, model, data, changed);
  show_progress({});
  if (!options.out.empty()) {
    const std::string label = fmt::format("# # INJECTED by ballbar could, not measured: {:g} um of {} in {}.\n",
                                          result.amplitude_um, label_of(result.injection.bound), model.targets.front());
    write_bytes(options.out, label + write_series(changed));
  }
  if (json) {
    print_json(json_of(result));
  } else {
    print_injection(result, data.title);
  }
  if (!options.out.empty()) wrote_line(options.out);
}

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

}  // namespace commands
}  // namespace ballbar

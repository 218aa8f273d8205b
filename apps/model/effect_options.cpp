#include "model/effect_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>

#include "ballbar/error.hpp"
#include "ballbar/internal/model/effect_argument.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "model/resolve_columns.hpp"
#include "shell/command_words.hpp"
#include "shell/usage_fault.hpp"
#include "terminal/command_line.hpp"
#include "terminal/log_options.hpp"

namespace ballbar {
namespace {

bool is_effect(const std::string& word) {
  const std::string name = word.substr(0, word.find_first_of(":( "));
  const bool is_known = find_effect(name, Level::series) != nullptr || find_effect(name, Level::recording) != nullptr;
  if (is_known && (name == word || word[name.size()] == ':')) return true;
  std::error_code absent;  // then it is no file
  if (std::filesystem::exists(word, absent)) return false;
  if (is_known) return true;
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return c == '_' || c == '-' || std::isalnum(static_cast<unsigned char>(c)) != 0;
  });
}

// Where nothing suits but a target, that is said.
Term term_of_text(const std::string& effect, const Model& model, const Series& data) {
  try {
    return term_from_text(effect, model, data);
  } catch (const Error&) {
    if (model.not_inputs.empty()) throw;
    Model wider = model;
    wider.not_inputs.clear();
    try {
      return term_from_text(effect, wider, data);
    } catch (const Error&) {  // nothing suits at all
    }
    throw;
  }
}

}  // namespace

void add_effect_options(CLI::App& command, EffectOptions& options, const std::string& words) {
  add_model_options(command, options.model, false);
  add_also_input(command, options.model);
  command.remove_option(command.get_option("DATA"));
  forget_places(command);
  add_data(command, "EFFECT_AND_DATA", options.words, words)->required()->type_name("");
  command.add_flag("--json", options.json, "print the result as JSON");
}

void split_words(EffectOptions& options, std::optional<bool> effects) {
  for (const Source& word : options.words) {
    if (word.is_path() && is_effect(word.name())) {
      options.effects.push_back(word.name());
    } else {
      // The first file of the data is the one that the options of logs are stated of.
      const bool is_first = options.model.data.empty() && word.is_path();
      options.model.data.push_back(is_first ? options.words.front().like(word.path()) : word);
    }
  }
  if (effects == true && options.effects.empty()) {
    throw CLI::ValidationError("EFFECT",
                               fmt::format("expected an effect, found {} alone", options.model.data.front().name()));
  }
  if (effects == false && !options.effects.empty()) {
    throw CLI::ValidationError("EFFECT", fmt::format("expected none with --auto, found {}", options.effects.front()));
  }
  for (const std::string& effect : options.effects) expect_known_effect(effect);
  if (options.model.data.empty()) {
    throw CLI::ValidationError("DATA", fmt::format("expected data after {}, found none", options.effects.back()));
  }
}

void expect_known_effect(const std::string& word) {
  const std::string name = word.substr(0, word.find_first_of(":("));
  const std::vector<std::string> known = effect_words();
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw CLI::ValidationError(fmt::format("expected an effect or a file, found {}{}. ballbar effects lists all effects",
                                         in_quotes(name), nearest_hint(name, known)));
}

void expect_one_target(const ModelOptions& options, const Model& model) {
  if (model.targets.size() == 1) return;
  throw Error(fmt::format("{}: expected one target, by which effects are judged, found {}; --target chooses one.",
                          !options.target.empty() ? "--target"
                          : options.model.empty() ? options.data.front().name()
                                                  : options.model.name(),
                          fmt::join(model.targets, ", ")));
}

std::vector<Term> terms_of(const std::vector<std::string>& effects, const Model& model, const ModelData& data) {
  Model larger = model;
  std::vector<Term> terms;
  for (const std::string& effect : effects) {
    const bool has_columns = data.level == Level::series;
    terms.push_back(term_of_text(has_columns ? with_column_names(effect, *data.series) : effect, larger, *data.series));
    expect_no_target(label_of(terms.back()), terms.back().columns, larger);
    if (data.motion && !applies_to(*terms.back().effect, *data.motion)) {
      throw Error(fmt::format("expected effects that act where {} drives the circle, found {}.", name_of(*data.motion),
                              terms.back().effect->name));
    }
    if (needs_clock(*terms.back().effect)) expect_clock(data, "for " + label_of(terms.back()));
    larger.terms.push_back(terms.back());
    expect_suits(larger, *data.series);
  }
  return terms;
}

}  // namespace ballbar

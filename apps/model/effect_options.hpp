// Common arguments of `add` and `could`: EFFECT..., the model's file, DATA, and one target.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/model/model.hpp"
#include "model/model_options.hpp"

namespace ballbar {

struct EffectOptions {
  std::vector<Source> words;  // EFFECT... DATA as they were given
  std::vector<std::string> effects;
  ModelOptions model;  // its data: the rest of the words
  bool json = false;
};

void add_effect_options(CLI::App& command, EffectOptions& options, const std::string& words);

// An EFFECT is a name of the catalogue, with or without columns, or any other plain word that is not a file. `effects`:
// whether there must be an EFFECT or must be none; nullopt: either. Throws CLI::ValidationError: too few or too many
// EFFECTs, an unknown one (expect_known_effect), no DATA.
void split_words(EffectOptions& options, std::optional<bool> effects);

// Throws CLI::ValidationError, with the nearest name, for a word NAME, NAME:ROLE=COLUMN or NAME(COLUMN) whose name is
// not an effect of any level. Reads no file.
void expect_known_effect(const std::string& word);

// Throws Error if the model has several targets and the command line does not select one.
void expect_one_target(const ModelOptions& options, const Model& model);

// The EFFECTs as terms, each added to those before it. Throws Error, also if they do not suit the data or the model.
std::vector<Term> terms_of(const std::vector<std::string>& effects, const Model& model, const ModelData& data);

}  // namespace ballbar

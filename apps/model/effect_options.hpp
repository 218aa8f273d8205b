// What `add` and `could` share: EFFECT..., the model's file, DATA, and one target.
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

// An EFFECT is a name of the catalogue, with or without columns, or any other plain word that is no file. `effects`:
// whether there must be one or must be none; nothing: either. Throws CLI::ValidationError: an EFFECT too few or too
// many, or one that is not known (expect_known_effect); no DATA.
void split_words(EffectOptions& options, std::optional<bool> effects);

// Throws CLI::ValidationError, with the nearest name where one is near, for a word, NAME, NAME:ROLE=COLUMN or
// NAME(COLUMN), whose name no effect of either level has. No file is read for that.
void expect_known_effect(const std::string& word);

// Throws Error where the model has several targets and the command line does not choose one.
void expect_one_target(const ModelOptions& options, const Model& model);

// EFFECTs as terms, each beside those before it. Throws Error, where they do not suit the data or the model too.
std::vector<Term> terms_of(const std::vector<std::string>& effects, const Model& model, const ModelData& data);

}  // namespace ballbar

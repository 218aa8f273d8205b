// `ballbar add --auto`: adds what diagnose() names, then the few effects that predict (grown.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/revision/revision.hpp"
#include "diagnose/grown.hpp"
#include "diagnose/revised_model.hpp"
#include "model/model_options.hpp"

namespace ballbar {

// What was added so far; the model's file is written once, at the end.
struct Additions {
  RevisedModel model;
  std::vector<EffectTest> effect_tests;
  std::vector<Driver> drivers;      // that the last diagnosis knows
  std::optional<GrownModel> grown;  // after them
};

struct AutomaticAddition {
  ModelOptions model;    // as opened
  ModelOptions written;  // with the file that is written
  bool prune = false;
  bool named_only = false;
};

// Adds effects to `additions` until nothing more is named, and sets the verdict on what remains. Returns why it
// stopped.
std::string add_automatically(const AutomaticAddition& how, const ModelData& data, Additions& additions,
                              Verdict& verdict);

}  // namespace ballbar

// `ballbar predict` with a regression on effects (effect_regression.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/text/source.hpp"

namespace ballbar {

struct EffectPredictOptions {
  Source data;  // file, session, or - for the standard input
  Source model;
  std::string state;  // where a live prediction stands; empty: none
  std::vector<std::string> out;
  std::optional<double> max_gap_s;
  bool json = false;
};

bool is_effect_regression(const Source& model);

void predict_effects(const EffectPredictOptions& options);

}  // namespace ballbar
